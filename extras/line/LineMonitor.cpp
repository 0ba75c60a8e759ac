#include "LineMonitor.h"

#include <algorithm>

namespace line {

void LineMonitor::reset(uint64_t nowUs, uint32_t characterUs) {
  _characterUs = characterUs;
  _waiting = 0;
  _finder.reset(static_cast<uint32_t>(nowUs), sbus::CharacterTime);
  _characters = 0;
  _badCharacters = 0;
}

void LineMonitor::put(const Character &character) {
  const uint64_t startUs = character.endUs - _characterUs;
  if (_characters == 0) {
    const uint32_t us = std::min<uint32_t>(_characterUs, UINT8_MAX);  // on a slower line there is no S.Bus
    _finder.reset(static_cast<uint32_t>(startUs), static_cast<uint8_t>(us));
  } else {
    idleUntil(startUs);
  }
  _characters++;
  _badCharacters += character.bad;
  _lastEndUs = character.endUs;
  if (!character.bad) {
    _burst[_waiting++] = character.value;
  }
  if (character.bad || _waiting == _burst.size()) {
    handOver(character.endUs);
  }
}

void LineMonitor::idleUntil(uint64_t nowUs) {
  if (nowUs >= _lastEndUs + _characterUs) {
    handOver(_lastEndUs + _characterUs);
  }
}

void LineMonitor::handOver(uint64_t nowUs) {
  if (_waiting == 0) {
    return;
  }
  _finder.poll(static_cast<unsigned>(_waiting), static_cast<uint32_t>(nowUs));
  for (size_t taken = 0; taken < _waiting;) {
    const size_t count = std::min(_waiting - taken, static_cast<size_t>(_finder.room()));
    std::copy_n(_burst.begin() + static_cast<std::ptrdiff_t>(taken), count, _finder.space());
    taken += count;
    _finder.received(static_cast<int>(count));
  }
  _waiting = 0;
}

}  // namespace line
