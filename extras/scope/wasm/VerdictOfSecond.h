// Finds a verdict for each whole second of the line's own time.
#pragma once

#include <optional>

#include "line/Examination.h"
#include "sbus/Diagnosis.h"

namespace scope {

class VerdictOfSecond {
 public:
  // Begins the first second.
  void begin(const line::Observer &observer, uint64_t nowUs) {
    _finding.reset();
    _beganUs = nowUs;
    _second.begin(observer, nowUs);
  }

  // Judges each second that is over by `nowUs`: all characters complete by then have come to a port with these
  // settings.
  void until(const line::Observer &observer, const line::LineSettings &port, uint64_t nowUs) {
    if (nowUs >= _beganUs + SecondUs) {
      judge(observer, port, nowUs);
    }
  }

  // Returns the finding of the last whole second; none before the first is over.
  std::optional<sbus::Finding> finding() const { return _finding; }
  // Returns true if frames had come by its end.
  bool hadFrames() const { return _hadFrames; }

 private:
  static constexpr uint64_t SecondUs = 1000000;

  // What has come belongs to the first second that is over; in the seconds after it the line was silent.
  void judge(const line::Observer &observer, const line::LineSettings &port, uint64_t nowUs) {
    const uint64_t seconds = (nowUs - _beganUs) / SecondUs;
    sbus::Diagnosis diagnosis;
    diagnosis.add(_second.trial(observer, port, _beganUs + SecondUs));
    _hadFrames = observer.newest().count > 0;
    _finding = seconds > 1 ? sbus::Finding::NoSignal : diagnosis.finding();
    _beganUs += seconds * SecondUs;
    _second.begin(observer, _beganUs);
  }

  line::Examination _second;
  uint64_t _beganUs = 0;
  std::optional<sbus::Finding> _finding;
  bool _hadFrames = false;
};

}  // namespace scope
