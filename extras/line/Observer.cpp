#include "Observer.h"

#include <algorithm>

namespace line {

namespace {

constexpr uint64_t LateUs = 50000;  // USB keeps bytes back for up to 16 ms, and a busy page for some more

constexpr uint64_t earlier(uint64_t us, uint64_t thanUs) {
  return thanUs - std::min(thanUs, us);
}

}  // namespace

void Observer::reset(uint64_t nowUs, uint32_t characterUs) {
  static_cast<Statistics &>(*this) = Statistics();
  _decoders.reset(nowUs, characterUs);
  _segments.reset(characterUs);
  _characterUs = characterUs;
  _lateUs = 0;
  _last = Character();
  _waits = false;
  _badCharacters = 0;
}

void Observer::put(const Character &character) {
  handOver(_last.endUs);
  idleUntil(earlier(_characterUs, character.endUs));
  take(character);
}

void Observer::putBurst(const uint8_t *bytes, size_t count, uint64_t nowUs) {
  handOver(_last.endUs);
  _lateUs = LateUs;
  idleUntil(earlier(count * _characterUs, nowUs));
  for (size_t i = 0; i < count; i++) {
    const uint64_t earliestUs = characters() == 0 ? 0 : _last.endUs + _characterUs;
    take({std::max(earliestUs, earlier((count - 1 - i) * _characterUs, nowUs)), bytes[i], false});
    handOver(nowUs);
  }
}

void Observer::idleUntil(uint64_t nowUs) {
  if (_waits && nowUs < _last.endUs + _characterUs) {
    return;
  }
  handOver(_last.endUs);
  _segments.cut(_decoders.idle(earlier(_lateUs, nowUs)));
  _segments.cutBefore(_decoders.openAt(_segments.end()), nowUs);
}

void Observer::finish() {
  handOver(_last.endUs);
  _segments.finish();
}

void Observer::take(const Character &character) {
  _last = character;
  _waits = !character.bad;
  _badCharacters += character.bad;
  _segments.put(character);
}

void Observer::handOver(uint64_t nowUs) {
  if (std::exchange(_waits, false)) {
    _segments.cut(_decoders.put(_last.value, _segments.end() - 1, nowUs));
  }
}

void Observer::say(Stretch &stretch) {
  if (stretch.isFrame()) {
    add(stretch);
  } else {
    for (const Rejected &rejected : _decoders.places().rejections) {
      if (rejected.at >= stretch.at && rejected.at < stretch.at + stretch.characters.size()) {
        stretch.rejected.push_back({rejected.at - stretch.at, rejected.why});
      }
    }
  }
  if (_listener) {
    _listener(stretch);
  }
}

}  // namespace line
