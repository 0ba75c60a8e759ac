#include "BoardPort.h"

#include <algorithm>
#include <utility>

namespace host {

void BoardPort::attach(line::Line &line, const line::LineSettings &wire) {
  _line = &line;
  _hasBegun = false;
  _wire = wire;
  _observer.reset(0, wire.characterUs());
  _receptions.clear();
  if (_uart.isOpen()) {
    listen(0);  // a constructor in the sketch opened it before main()
  }
}

void BoardPort::rewire(uint64_t nowUs, const line::LineSettings &wire) {
  _wire = wire;
  if (_uart.isOpen()) {
    listen(nowUs);
  }
}

void BoardPort::open(uint64_t nowUs, const PortSettings &settings, uint8_t *buffer, size_t size) {
  _settings = settings;
  if (buffer == nullptr) {
    _uart.open(nowUs, settings.rx.characterUs());
  } else {
    _uart.open(nowUs, buffer, size, settings.rx.characterUs());
  }
  listen(nowUs);
  if (_line != nullptr) {
    _line->share(settings.tx);
  }
  if (_uart.isOpen()) {
    _sender.open(nowUs, settings);
  } else {
    _sender.close();
  }
  if (!_everOpened && _line != nullptr) {
    _line->opened(nowUs);
  }
  _everOpened = true;
}

void BoardPort::close() {
  _uart.close();
  _sender.close();
}

void BoardPort::onReceive(std::function<void()> callback, const void *listener) {
  _changedListener |= _listener != nullptr && listener != nullptr && _listener != listener;
  _listener = listener;
  _callback = std::move(callback);
}

// Starts over with the current settings of port and wire.
void BoardPort::listen(uint64_t nowUs) {
  _agrees = mismatch(_settings.rx, _wire).empty();
  _sampler.open(nowUs, _settings.rx, _wire);
  const auto same = std::find_if(_receptions.begin(), _receptions.end(), [this](const Reception &reception) {
    return reception.settings == _settings && reception.wire == _wire;
  });
  _reception = static_cast<size_t>(same - _receptions.begin());
  if (same == _receptions.end()) {
    _receptions.emplace_back();
    _receptions.back().settings = _settings;
    _receptions.back().wire = _wire;
  }
}

void BoardPort::receive(uint64_t nowUs) {
  while (hasBegun(nowUs) && _begun.endUs <= nowUs) {
    const line::Character character = _begun;
    _hasBegun = false;
    _observer.put(character);
    if (!_uart.isOpen()) {
      _missedClosed++;
      continue;
    }
    _receptions[_reception].sent++;
    if (_agrees) {
      take(character);
    } else {
      _sampler.put(character);
    }
  }
  if (!_uart.isOpen()) {
    return;
  }
  if (_agrees) {
    // While the next character arrives, the line is not idle (STM32L082's reference manual RM0376, USART_ISR: IDLE).
    _uart.advance(_hasBegun ? std::min(nowUs, _begun.endUs - _wire.characterUs()) : nowUs);
    return;
  }
  line::Character character;
  while (_sampler.next(nowUs, character)) {
    take(character);
  }
  _uart.advance(nowUs - std::min<uint64_t>(nowUs, _wire.characterUs()));  // the sampler knows no more, see next()
}

uint64_t BoardPort::nextUs(uint64_t nowUs) {
  const uint64_t idleUs = _uart.idleFromUs();
  const uint64_t endUs = hasBegun(nowUs) ? _begun.endUs : UINT64_MAX;
  return idleUs > nowUs ? std::min(idleUs, endUs) : endUs;
}

// Returns true if a character is on the wire at `nowUs`, or has ended but has not been taken.
bool BoardPort::hasBegun(uint64_t nowUs) {
  _hasBegun = _hasBegun || (_line != nullptr && _line->next(nowUs + _wire.characterUs(), _begun));
  return _hasBegun;
}

void BoardPort::take(const line::Character &character) {
  Reception &reception = _receptions[_reception];
  (character.bad ? reception.bad : reception.good)++;
  _uart.receive(character);
}

void BoardPort::shareWire(const line::Character &character) {
  if (_line != nullptr) {
    _line->hear(character);
  }
}

void BoardPort::callBack() {
  // As on the board, an event without a callback is lost, and the next one comes only after a read.
  if (_uart.takeReceiveEvent() && _callback) {
    const std::function<void()> callback = _callback;  // it may set another one
    callback();
  }
}

}  // namespace host
