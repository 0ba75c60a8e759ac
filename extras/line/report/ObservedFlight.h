// A flight from a line's characters.
#pragma once

#include <algorithm>

#include "line/Observer.h"
#include "line/report/FlightLog.h"

namespace line {

class ObservedFlight {
 public:
  // `zeroUs`: see FlightLog.
  explicit ObservedFlight(uint32_t characterUs, int64_t zeroUs = 0) : _log(zeroUs) {
    _observer.reset(0, characterUs);
    _observer.listen([this](const Stretch &stretch) { take(stretch); });
  }
  ObservedFlight(const ObservedFlight &) = delete;  // its observer's listener points to it
  ObservedFlight &operator=(const ObservedFlight &) = delete;

  void put(const Character &character) { _observer.put(character); }
  void idleUntil(uint64_t us) { _observer.idleUntil(us); }
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
      FlightFrame frame{stretch.kind, stretch.characters.back().value, stretch.endUs(), stretch.lateUs(),
                        _observer.inFailsafe(), newest.lostFrame, newest.hasNoPulses(), newest.raw, newest.count};
      _log.put(frame);
    }
  }

  Observer _observer;
  FlightLog _log;
};

}  // namespace line
