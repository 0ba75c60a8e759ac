// Counts what a line carries from a moment on, for sbus::Diagnosis. `sbus doctor` and the page use it, and a sketch's
// decoder counts in the same way, so all three report the same finding for a line.
#pragma once

#include <cstdint>

#include "line/LineSettings.h"
#include "line/Observer.h"
#include "sbus/Diagnosis.h"

namespace line {

class Examination {
 public:
  // Begins at `nowUs`, in the line's time.
  void begin(const Observer &observer, uint64_t nowUs);

  // Returns what a port with these settings received from begin() to `nowUs`.
  sbus::Trial trial(const Observer &observer, const LineSettings &port, uint64_t nowUs) const;

 private:
  sbus::Counters _before{};
  uint32_t _pulselessBefore = 0;
  unsigned long _errorsBefore = 0;
  uint64_t _beganUs = 0;
};

// Returns true if the line has no fault and needs no other decoder.
constexpr bool isWell(sbus::Finding finding) {
  return finding == sbus::Finding::AllWell || finding == sbus::Finding::AllWellAndMore;
}

}  // namespace line
