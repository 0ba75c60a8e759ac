/// @file
/// Measures by millis() how long micros() has stood still: on some cores it does while the board sleeps.
#pragma once

#include <stdint.h>

#include "Barrier.h"

namespace sbus {

/// Corrects the age of a frame by millis(). Times are in us, as micros() shows them, and wrap after 71 minutes; `ms` is
/// millis(), and wraps after 49 days. Read millis() before micros() where both are asked for.
///
/// The context that reads the port calls frame(), which may interrupt age(): then call age() again.
class SleepClock {
 public:
  /// The board has never slept.
  void reset() { _ms = Never; }

  /// The board is about to sleep: until now both clocks have run alike, or since the newest frame.
  void beforeSleep(uint32_t now, uint32_t ms) {
    if (!hasEverSlept()) {
      frame(now, ms == Never ? ms - 1 : ms);
    }
  }

  /// Returns true if the methods below matter: call none of them before.
  bool hasEverSlept() const { return _ms != Never; }

  /// Takes the newest frame, with its FrameFinder::frameTime(), at the moment when it is complete. (`Never` re-arms
  /// it at the next sleep.)
  void frame(uint32_t time, uint32_t ms) {
    _time = time;
    barrier();
    _ms = ms;
  }

  /// Returns true if micros() has stood still for 50 ms or more between the newest frame and now. A frame that is
  /// complete now may then have come before the sleep, or consist of parts of two.
  ///
  /// If the clocks' rates differ by 1 %, it also returns true after 5 s awake without a frame: that costs one frame.
  bool hasSlept(uint32_t now, uint32_t ms) const {
    const uint32_t stood = (ms - _ms) * 1000 - (now - _time);  // millis() * 1000 wraps as micros() does
    return stood - Sleep < UINT32_MAX - Sleep - Behind;
  }

  /// Returns the age, at `now`, of what came at `time`, near the newest frame's: 0..UINT32_MAX, 71 minutes or more. It
  /// includes how long micros() has certainly stood still since that frame. If frame() has interrupted it, it returns
  /// the age that micros() says.
  uint32_t age(uint32_t time, uint32_t now, uint32_t ms) const {
    const uint32_t lasted = ms - _ms + Before;
    if (lasted > LastedMax + Before) {
      return UINT32_MAX;
    }
    const uint32_t least = lasted > Before + Ticks ? (lasted - Before - Ticks) * 1000 : 0;
    return now - time + (least > now - _time ? least - (now - _time) : 0);
  }

 private:
  static constexpr uint32_t Never = UINT32_MAX;  // ms, once in 49 days
  static constexpr uint32_t Sleep = 50000;       // us: longer than any frame period
  static constexpr uint32_t Behind = 1 << 26;    // us: 1 % of a wrap and more, by which millis() is slow
  static constexpr uint32_t Ticks = 2;           // ms: in no time at all millis() may gain 1.5 ms
  static constexpr uint32_t LastedMax = UINT32_MAX / 1000 - 10;  // ms: shortly before micros() wraps
  static constexpr uint32_t Before = 1000;                       // ms: `ms` may be that of an interrupted call

  uint32_t _time;
  uint32_t _ms;
};

}  // namespace sbus
