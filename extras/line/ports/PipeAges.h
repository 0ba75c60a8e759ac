// Tells since when what a pipe brings may have waited, if it does not say so itself.
#pragma once

#include <algorithm>
#include <cstdint>

#include "line/system/System.h"

namespace line {

// It was not there when the pipe was last empty. But its writer may have been late, too. Then more comes than fits on
// a line in that time: until the pipe keeps to a line's pace again, or for a moment after a silence, nothing is known.
class PipeAges {
 public:
  static constexpr uint64_t Unknown = 1;  // since the PC was started

  // Takes an empty pipe.
  void empty() { _emptyUs = clockUs(); }

  // Takes characters that have come now, and last for `lineUs` on a line. Returns since when they may have waited.
  uint64_t came(uint64_t lineUs) {
    const uint64_t nowUs = clockUs();
    const uint64_t silenceUs = nowUs - _nowUs;
    _nowUs = nowUs;
    _aheadUs = _aheadUs - std::min(_aheadUs, silenceUs) + lineUs;
    if (silenceUs > SilenceUs || _aheadUs > AheadUs) {
      _unknownUntilUs = nowUs + ProbationUs;
    }
    return nowUs < _unknownUntilUs ? Unknown : _emptyUs;
  }

 private:
  static constexpr uint64_t SilenceUs = 80000;    // a frame is old after 100 ms
  static constexpr uint64_t AheadUs = 20000;      // an adapter holds bytes back for 16 ms
  static constexpr uint64_t ProbationUs = 50000;  // in this time six frames of 3 ms, sent at once, exceed AheadUs

  uint64_t _emptyUs = Unknown;
  uint64_t _nowUs = 0;
  uint64_t _aheadUs = 0;  // what has come lasts so much longer on a line than it took
  uint64_t _unknownUntilUs = 0;
};

}  // namespace line
