// Counts what a line has brought since a moment, for sbus::Diagnosis. `sbus doctor` and the page judge by this, and a
// sketch's decoder counts in the same way: all three have the same finding for a line.
#pragma once

#include <cstdint>

#include "line/LineSettings.h"
#include "line/Observer.h"
#include "sbus/Diagnosis.h"

namespace line {

class Examination {
 public:
  // Begins at `nowUs`, in the line's time: what came before does not count.
  void begin(const Observer &observer, uint64_t nowUs);

  // Returns what a port with these settings has received from begin() to `nowUs`.
  sbus::Trial trial(const Observer &observer, const LineSettings &port, uint64_t nowUs) const;

 private:
  sbus::Counters _before{};
  unsigned long _errorsBefore = 0;
  uint64_t _beganUs = 0;
};

// Returns true if there is nothing to do: the line has no fault, and needs no other decoder.
constexpr bool isWell(sbus::Finding finding) {
  return finding == sbus::Finding::AllWell || finding == sbus::Finding::AllWellAndMore;
}

}  // namespace line
