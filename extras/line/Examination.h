// What has come of a line since a moment, as sbus::Diagnosis takes it. `sbus doctor` and the page both judge by this,
// and a sketch's decoder counts the same: a line gets the same finding from each.
#pragma once

#include <cstdint>

#include "line/simulation/LineSettings.h"
#include "line/Observer.h"
#include "sbus/Diagnosis.h"

namespace line {

class Examination {
 public:
  // What has come up to `nowUs`, in the line's time, does not count.
  void begin(const Observer &observer, uint64_t nowUs);

  // Returns what has come since then, up to `nowUs`, to a port that is set so.
  sbus::Trial trial(const Observer &observer, const LineSettings &port, uint64_t nowUs) const;

 private:
  sbus::Counters _before{};
  unsigned long _badBefore = 0;
  uint64_t _beganUs = 0;
};

// True if nothing is to be done about it: no fault of the line, and no other decoder either.
constexpr bool isWell(sbus::Finding finding) {
  return finding == sbus::Finding::AllWell || finding == sbus::Finding::AllWellAndMore;
}

}  // namespace line
