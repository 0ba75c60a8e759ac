#include "LineMonitor.h"

#include <algorithm>

namespace line {

namespace {

template <typename Finder>
void feed(Finder &finder, const uint8_t *bytes, size_t count, uint64_t nowUs) {
  finder.poll(static_cast<unsigned>(count), static_cast<uint32_t>(nowUs));
  while (count > 0) {
    const size_t taken = std::min(count, static_cast<size_t>(finder.room()));
    std::copy_n(bytes, taken, finder.space());
    bytes += taken;
    count -= taken;
    finder.received(static_cast<int>(taken));
  }
}

}  // namespace

void LineMonitor::reset(uint64_t nowUs, uint32_t characterUs) {
  _characterUs = characterUs;
  _waiting = 0;
  resetFinders(nowUs, sbus::CharacterTime);
  _characters = 0;
  _badCharacters = 0;
}

void LineMonitor::put(const Character &character) {
  const uint64_t startUs = character.endUs - _characterUs;
  if (_characters == 0) {
    const uint32_t us = std::min<uint32_t>(_characterUs, UINT8_MAX);  // on a slower line there is no S.Bus
    resetFinders(startUs, us);
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
  feed(_finder, _burst.data(), _waiting, nowUs);
  feed(_finder24, _burst.data(), _waiting, nowUs);
  _waiting = 0;
}

void LineMonitor::resetFinders(uint64_t nowUs, uint32_t characterUs) {
  _finder.reset(static_cast<uint32_t>(nowUs), static_cast<uint8_t>(characterUs));
  _finder24.reset(static_cast<uint32_t>(nowUs), static_cast<uint8_t>(characterUs));
}

}  // namespace line
