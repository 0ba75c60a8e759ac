// Finds a verdict for each whole second of the line's own time.
#pragma once

#include <optional>

#include "line/Examination.h"

namespace scope {

class VerdictOfSecond {
 public:
  // Begins the first second.
  void begin(const line::Observer &observer, uint64_t nowUs);

  // Judges each second that is over by `nowUs`: all characters complete by then have come to a port with these
  // settings.
  void until(const line::Observer &observer, const line::LineSettings &port, uint64_t nowUs) {
    if (nowUs >= _beganUs + SecondUs) {
      judge(observer, port, nowUs);
    }
  }

  // Returns the finding of the last whole second; none before the first is over.
  std::optional<sbus::Finding> finding() const { return _finding; }

 private:
  static constexpr uint64_t SecondUs = 1000000;

  void judge(const line::Observer &observer, const line::LineSettings &port, uint64_t nowUs);

  line::Examination _second;
  uint64_t _beganUs = 0;
  std::optional<sbus::Finding> _finding;
};

}  // namespace scope
