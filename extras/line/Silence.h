// Tells silence on the line from a late read by the PC.
#pragma once

#include <cstdint>

#include "sbus/Link.h"

namespace line {

// A longer time without a frame is a silence. A read this late or later shows that the PC was busy.
constexpr uint64_t SilenceUs = sbus::Link::DefaultTimeout * 1000;

enum class Gap { Ordinary, Silent, Late };

// Classifies the gap between a frame or row that ended at `beforeUs` and the next, at `us`, which the port may have
// held back for `lateUs`. The line counts as silent after `limitUs` without frames.
constexpr Gap gapOf(uint64_t beforeUs, uint64_t us, uint64_t lateUs, uint64_t limitUs = SilenceUs) {
  return us - beforeUs <= limitUs                                   ? Gap::Ordinary
         : lateUs >= SilenceUs && us - beforeUs <= limitUs + lateUs ? Gap::Late
                                                                    : Gap::Silent;
}

}  // namespace line
