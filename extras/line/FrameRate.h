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
  // Takes the next frame. `isJoined`: the line was not silent before it.
  void put(uint64_t us, uint32_t lateUs, bool isJoined) {
    const bool isOnTime = lateUs < SilenceUs;  // a busy PC reads many at once
    _frames++;
    _lateFrames += lateUs > ExactUs;
    _lateUs += isOnTime ? lateUs : 0;
    if (isJoined) {
      _intervals[(us - _lastUs + 500) / 1000]++;
    }
    _run = isJoined && isOnTime ? _run + 1 : 0;
    if (_run == RunFrames) {
      Runs &runs = _runs[(us - _runUs) / RunFrames / 1000];
      runs.count++;
      runs.us += us - _runUs;
      _run = 0;
    }
    _runUs = _run == 0 ? us : _runUs;
    _lastUs = us;
  }

  // Returns the number of frames for each interval, in rounded milliseconds, from the end of the previous frame.
  const std::map<uint64_t, unsigned long> &intervals() const { return _intervals; }

  // Returns the expected frames per second; 0 if unknown. The most frequent interval is the receiver's, in whole
  // milliseconds; the frames near it give its fraction.
  double perSecond() const {
    const double us = isLate() ? periodOfRuns() : periodOfIntervals();
    return us > 0 ? 1e6 / us : 0;
  }

  // Returns the number of frames missing between frames less than 0.1 s apart.
  unsigned long missing() const {
    const double perMs = perSecond() / 1000;
    double missing = 0;
    if (isLate()) {
      const uint64_t usual = usualOf(_runs);
      for (const auto &[ms, runs] : _runs) {
        missing += isNear(ms, usual, 1) ? 0 : static_cast<double>(runs.us) / 1000 * perMs - static_cast<double>(runs.count * RunFrames);
      }
      return static_cast<unsigned long>(std::max(0.0, missing));
    }
    for (const auto &[ms, count] : _intervals) {
      const double periods = std::round(static_cast<double>(ms) * perMs);
      missing += periods > 1 ? (periods - 1) * static_cast<double>(count) : 0;
    }
    return static_cast<unsigned long>(missing);
  }

  // Returns how many frames may have come before a time, or after it, because the port was late.
  double uncertain() const {
    return isLate() ? static_cast<double>(_lateUs) / static_cast<double>(_frames) / 1e6 * perSecond() : 0;
  }

 private:
  static constexpr uint32_t ExactUs = 4000;  // below half a period
  static constexpr unsigned RunFrames = 64;  // half a second: an adapter's 16 ms are 3 % of it

  // Runs of frames without a silence that took as long.
  struct Runs {
    unsigned long count = 0;
    uint64_t us = 0;
  };
  static unsigned long countOf(unsigned long count) { return count; }
  static unsigned long countOf(const Runs &runs) { return runs.count; }

  bool isLate() const { return 2 * _lateFrames > _frames; }

  static bool isNear(uint64_t ms, uint64_t usual, uint64_t near) { return ms + near >= usual && ms <= usual + near; }

  template <typename Values>
  static uint64_t usualOf(const std::map<uint64_t, Values> &values) {
    const auto most = std::max_element(values.begin(), values.end(),
                                       [](const auto &a, const auto &b) { return countOf(a.second) < countOf(b.second); });
    return most == values.end() ? 0 : most->first;
  }

  double periodOfIntervals() const {
    const uint64_t usual = usualOf(_intervals);
    double us = 0, count = 0;
    for (const auto &[ms, frames] : _intervals) {
      if (usual > 0 && isNear(ms, usual, 2)) {
        us += 1000.0 * static_cast<double>(ms) * static_cast<double>(frames);
        count += static_cast<double>(frames);
      }
    }
    return count > 0 ? us / count : 0;
  }

  double periodOfRuns() const {
    const uint64_t usual = usualOf(_runs);
    double us = 0, count = 0;
    for (const auto &[ms, runs] : _runs) {
      if (isNear(ms, usual, 1)) {
        us += static_cast<double>(runs.us);
        count += static_cast<double>(runs.count * RunFrames);
      }
    }
    return count > 0 ? us / count : _run > 0 ? static_cast<double>(_lastUs - _runUs) / _run : 0;
  }

  unsigned long _frames = 0;
  unsigned long _lateFrames = 0;
  uint64_t _lateUs = 0;  // the sum
  uint64_t _lastUs = 0;
  std::map<uint64_t, unsigned long> _intervals;
  std::map<uint64_t, Runs> _runs;  // by their mean interval in ms
  uint64_t _runUs = 0;             // when the newest run began
  unsigned _run = 0;               // its frames
};

}  // namespace line
