// A flight from a line's characters.
#pragma once

#include <algorithm>

#include "line/Observer.h"
#include "line/report/FlightLog.h"

namespace line {

class ObservedFlight {
 public:
  // `zeroUs`: see FlightLog.
  explicit ObservedFlight(uint32_t characterUs, int64_t zeroUs = 0) : _characterUs(characterUs), _log(zeroUs) {
    _observer.reset(0, characterUs);
    _observer.listen([this](const Stretch &stretch) { take(stretch); });
  }
  ObservedFlight(const ObservedFlight &) = delete;  // its observer's listener points to it
  ObservedFlight &operator=(const ObservedFlight &) = delete;

  // Takes the time at which a capture begins, before its first character.
  void begin(uint64_t us) { _log.heard(us, true); }

  void put(const Character &character) {
    _log.heard(character.endUs - std::min<uint64_t>(character.endUs, _characterUs + character.lateUs));
    _log.heard(character.endUs);
    _observer.put(character);
  }

  // Takes the time up to which the line is known. `isOver`: the line has ended before, and the time says nothing.
  void idleUntil(uint64_t us, bool isOver = false) {
    if (!isOver && _observer.characters() > 0) {
      _log.heard(us, true);
    }
    _observer.idleUntil(us);
  }
  void finish() {
    _observer.finish();
    const sbus::Counters counters = _observer.counters();
    _log.finish({counters.frames, counters.lostFrames, counters.failsafeFrames, _observer.discardedBytes(),
                 _observer.characterErrors()});
  }

  bool any() const { return _observer.counters().frames > 0; }
  const Observer &observer() const { return _observer; }
  const FlightLog &log() const { return _log; }

 private:
  void take(const Stretch &stretch) {
    const Values &newest = _observer.newest();
    if (stretch.isFrame()) {
      FlightFrame frame{stretch.kind,
                        stretch.characters.back().value,
                        stretch.endUs(),
                        stretch.lateUs(),
                        _observer.inFailsafe(),
                        newest.lostFrame,
                        newest.hasNoPulses(),
                        newest.raw,
                        newest.count};
      _log.put(frame);
    }
  }

  const uint32_t _characterUs;
  Observer _observer;
  FlightLog _log;
};

}  // namespace line
