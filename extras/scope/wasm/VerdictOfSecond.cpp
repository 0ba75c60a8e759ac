#include "VerdictOfSecond.h"

#include "sbus/Diagnosis.h"

namespace scope {

void VerdictOfSecond::begin(const line::Observer &observer, uint64_t nowUs) {
  _finding.reset();
  _beganUs = nowUs;
  _second.begin(observer, nowUs);
}

// What has come belongs to the first second that is over; in the seconds after it the line was silent.
void VerdictOfSecond::judge(const line::Observer &observer, const line::LineSettings &port, uint64_t nowUs) {
  const uint64_t seconds = (nowUs - _beganUs) / SecondUs;
  sbus::Diagnosis diagnosis;
  diagnosis.add(_second.trial(observer, port, _beganUs + SecondUs));
  _finding = seconds > 1 ? sbus::Finding::NoSignal : diagnosis.finding();
  _beganUs += seconds * SecondUs;
  _second.begin(observer, _beganUs);
}

}  // namespace scope
