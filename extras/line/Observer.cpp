#include "Observer.h"

#include <algorithm>

namespace line {

namespace {

constexpr uint64_t earlier(uint64_t us, uint64_t thanUs) {
  return thanUs - std::min(thanUs, us);
}

}  // namespace

void Observer::reset(uint64_t nowUs, uint32_t characterUs) {
  static_cast<Statistics &>(*this) = Statistics();
  _decoders.reset(nowUs, characterUs);
  _segments.reset(characterUs);
  _characterUs = characterUs;
  _last = Character();
  _last.endUs = nowUs;
  _lineUs = nowUs;
  _silenceUs = 0;
  _waits = false;
  _badCharacters = 0;
}

void Observer::put(const Character &character) {
  handOver();
  idleUntil(earlier(_characterUs + character.lateUs, character.endUs));
  _lineUs += _silenceUs + _characterUs;
  _silenceUs = 0;
  _last = character;
  _waits = !character.bad;
  _badCharacters += character.bad;
  _segments.put(character);
}

void Observer::idleUntil(uint64_t nowUs) {
  const uint64_t silenceUs = earlier(_last.endUs, nowUs);
  if (_waits && silenceUs < _characterUs) {
    return;
  }
  handOver();
  _silenceUs = std::max(_silenceUs, silenceUs);
  _segments.cut(_decoders.idle(_lineUs + _silenceUs));
  _segments.cutBefore(_decoders.openAt(_segments.end()), _last.endUs + _silenceUs);
}

void Observer::finish() {
  handOver();
  _segments.cut(_decoders.finish());
  _segments.finish();
}

void Observer::handOver() {
  if (std::exchange(_waits, false)) {
    _segments.cut(_decoders.put(_last.value, _segments.end() - 1, _lineUs, _last.lateUs > 0));
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
