/// @file
/// Decides whether characters that came slowly may be parts of several frames, where interrupts stop unnoticed.
#pragma once

#include <stdint.h>

namespace sbus {

/// Knows since when the incoming frame may have begun. While interrupts are off a UART loses characters, and what is
/// left of several frames may look like one. The parts after the first come a frame period later, or more, so together
/// they take a period longer than a frame.
///
/// A loop() that polls rarely shows whole frames in the same way. So the third such frame in a row is believed: the
/// first two cost it two frames after each damaged one.
///
/// `IsNeeded` is false where the clock runs on (LineTiming.h): there FrameFinder::checkFound() notices the loss, and
/// this class is empty.
template <bool IsNeeded>
class LateFrames {
 public:
  /// The incoming frame had not begun at this time, us.
  void beganAfter(uint32_t time) { _after = time; }

  /// Returns true if parts of several frames may have come by the time `now`, us. The characters since the frame began
  /// take `us`, and are `frames` frames, 1 or 2.
  bool mayBeJoined(uint32_t now, uint32_t us, uint8_t frames, uint32_t period) const {
    const uint32_t each = period - 1 < LongestPeriod ? period : LongestPeriod;
    return static_cast<int32_t>(now - _after - us - frames * each) >= 0;
  }

  /// Takes a frame that may be joined; `isNext`: it directly follows the previous frame. Returns true if it must not be
  /// delivered.
  bool mustWait(bool isNext) {
    if (!isNext) {
      _inRow = 0;
    } else if (_inRow == Most) {
      return false;
    }
    _inRow++;
    return true;
  }

 private:
  static constexpr uint32_t LongestPeriod = 8000;  // us: a longer one may have been measured between late polls
  static constexpr uint8_t Most = 2;               // frames

  uint32_t _after = 0;
  uint8_t _inRow = 0;
};

/// Where the clock runs on.
template <>
class LateFrames<false> {
 public:
  void beganAfter(uint32_t) {}                                                           ///< does nothing
  static constexpr bool mayBeJoined(uint32_t, uint32_t, uint8_t, uint32_t) { return false; }  ///< returns false
  static constexpr bool mustWait(bool) { return false; }                                ///< returns false
};

}  // namespace sbus
