#include "LineMonitor.h"

#include <algorithm>

namespace host {

void LineMonitor::reset(uint64_t nowUs, uint32_t characterUs) {
  const uint32_t us = std::min<uint32_t>(characterUs, UINT8_MAX);  // on a slower wire there is no S.Bus
  _receiver.reset(static_cast<uint32_t>(nowUs), static_cast<uint8_t>(us));
  _characters = 0;
  _badCharacters = 0;
}

void LineMonitor::look(const Character &character) {
  _characters++;
  if (character.bad) {
    _badCharacters++;
    return;
  }
  *_receiver.space() = character.value;
  _receiver.received(1, 0, static_cast<uint32_t>(character.endUs));
}

void LineMonitor::settle(uint64_t nowUs) {
  _receiver.received(0, 0, static_cast<uint32_t>(nowUs));
}

}  // namespace host
