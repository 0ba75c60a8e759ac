// The rate of a line's frames, and how many are missing. A port that delivers late has only the times of its reads,
// which over many frames are those of the line.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

#include "line/Silence.h"

namespace line {

class FrameRate {
 public:
  // Intervals of about as many milliseconds.
  struct Intervals {
    unsigned long count = 0;
    uint64_t us = 0;  // the sum
  };
  using ByMs = std::map<uint64_t, Intervals>;

  // Takes the next frame. `isJoined`: the line was not silent before it.
  void put(uint64_t us, uint32_t lateUs, bool isJoined) {
    const bool isOnTime = lateUs < SilenceUs;  // a busy PC reads many at once
    _frames++;
    _lateFrames += lateUs > ExactUs;
    _lateUs += isOnTime ? lateUs : 0;
    if (isJoined) {
      const uint64_t ms = (us - _lastUs + 500) / 1000;
      add(_intervals[ms], 1, 1000 * ms);
    }
    _run = isJoined && isOnTime ? _run + 1 : 0;
    if (_run == RunFrames) {
      add(_runs[(us - _runUs) / RunFrames / 1000], RunFrames, us - _runUs);
      _run = 0;
    }
    _runUs = _run == 0 ? us : _runUs;
    _lastUs = us;
  }

  // Returns the frame intervals by their length in rounded milliseconds, from the end of the previous frame.
  const ByMs &intervals() const { return _intervals; }

  // Returns the expected frames per second; 0 if unknown. The most frequent interval is the receiver's, in whole
  // milliseconds; the frames near it give its fraction.
  double perSecond() const {
    const Intervals usual = sumOf(true);
    return usual.us > 0 ? 1e6 * static_cast<double>(usual.count) / static_cast<double>(usual.us) : 0;
  }

  // Returns the number of frames missing between frames less than 0.1 s apart.
  unsigned long missing() const {
    const double perUs = perSecond() / 1e6;
    if (isLate()) {
      const Intervals other = sumOf(false);
      return static_cast<unsigned long>(
          std::max(0.0, static_cast<double>(other.us) * perUs - static_cast<double>(other.count)));
    }
    unsigned long missing = 0;
    for (const auto &[ms, each] : _intervals) {
      const double periods = std::round(static_cast<double>(1000 * ms) * perUs);
      missing += periods > 1 ? static_cast<unsigned long>(periods - 1) * each.count : 0;
    }
    return missing;
  }

  // Returns how many frames may have come before a time, or after it, because the port was late.
  double uncertain() const {
    return isLate() ? static_cast<double>(_lateUs) / static_cast<double>(_frames) / 1e6 * perSecond() : 0;
  }

 private:
  static constexpr uint32_t ExactUs = 4000;  // below half a period
  static constexpr unsigned RunFrames = 64;  // half a second: an adapter's 16 ms are 3 % of it

  static void add(Intervals &intervals, unsigned long count, uint64_t us) {
    intervals.count += count;
    intervals.us += us;
  }

  bool isLate() const { return 2 * _lateFrames > _frames; }
  const ByMs &measured() const { return isLate() ? _runs : _intervals; }

  // Returns the sum of the intervals near the most frequent one, or of the others.
  Intervals sumOf(bool areNear) const {
    const uint64_t nearMs = isLate() ? 1 : 2;
    const auto most = std::max_element(measured().begin(), measured().end(),
                                       [](const auto &a, const auto &b) { return a.second.count < b.second.count; });
    Intervals sum;
    for (const auto &[ms, each] : measured()) {
      if ((most->first > 0 && ms + nearMs >= most->first && ms <= most->first + nearMs) == areNear) {
        add(sum, each.count, each.us);
      }
    }
    return sum;
  }

  unsigned long _frames = 0;
  unsigned long _lateFrames = 0;
  uint64_t _lateUs = 0;  // the sum
  uint64_t _lastUs = 0;
  ByMs _intervals;
  ByMs _runs;           // of runs without a silence, by their mean interval
  uint64_t _runUs = 0;  // when the newest run began
  unsigned _run = 0;    // its frames
};

}  // namespace line
