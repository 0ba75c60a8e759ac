#include "Port.h"

namespace host {

void Port::open(uint64_t nowUs, const PortSettings &settings, uint8_t *buffer, size_t size) {
  _settings = settings;
  if (buffer == nullptr) {
    _uart.open(nowUs);
  } else {
    _uart.open(nowUs, buffer, size);
  }
  if (!_everOpened && _line != nullptr) {
    _line->opened(nowUs);
  }
  _everOpened = true;
}

void Port::receive(uint64_t nowUs) {
  Character character;
  while (_line != nullptr && _line->next(nowUs, character)) {
    _monitor.look(character);
    if (!_uart.isOpen()) {
      _missedClosed++;
    } else if (!understandsSBus(_settings, _line->inverted())) {
      _missedSettings++;
    } else {
      _uart.receive(character);
    }
  }
  _uart.advance(nowUs);
}

void Port::callBack() {
  if (_callback != nullptr && _uart.takeReceiveEvent()) {
    _callback();
  }
}

}  // namespace host
