#include "LineMonitor.h"

#include <algorithm>

namespace host {

void LineMonitor::reset(uint64_t nowUs, uint32_t characterUs) {
  _characterUs = characterUs;
  _uart.open(nowUs, characterUs);
  _receiver.reset(static_cast<uint32_t>(nowUs), sbus::CharacterTime);
  _characters = 0;
  _badCharacters = 0;
}

void LineMonitor::look(const Character &character) {
  const uint64_t startUs = character.endUs - _characterUs;
  if (_characters == 0) {
    const uint32_t us = std::min<uint32_t>(_characterUs, UINT8_MAX);  // on a slower wire there is no S.Bus
    _receiver.reset(static_cast<uint32_t>(startUs), static_cast<uint8_t>(us));
  } else {
    settle(startUs);
  }
  _characters++;
  _badCharacters += character.bad;
  _uart.receive(character);
  _lastEndUs = character.endUs;
  poll(character.endUs);
}

void LineMonitor::settle(uint64_t nowUs) {
  _uart.advance(nowUs);
  poll(_lastEndUs + _characterUs);
}

void LineMonitor::poll(uint64_t nowUs) {
  int waiting = _uart.available();
  if (waiting > 0) {
    _receiver.poll(static_cast<unsigned>(waiting), static_cast<uint32_t>(nowUs));
  }
  while (waiting > 0) {
    const int count = _uart.read(_receiver.space(), static_cast<size_t>(std::min(waiting, _receiver.room())));
    waiting -= count;
    _receiver.received(count);
  }
}

}  // namespace host
