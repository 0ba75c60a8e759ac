// Tells a silence of the line from a PC that read it late.
#pragma once

#include <cstdint>

#include "sbus/Link.h"

namespace line {

// Longer times without a frame are a silence. A read that may be this late, or later, shows that the PC was busy.
constexpr uint64_t SilenceUs = sbus::Link::DefaultTimeout * 1000;

enum class Gap { Ordinary, Silent, Late };

// Returns what lies between a frame or row that was complete at `beforeUs` and the next one, at `us`. The port may have
// held that back for `lateUs`; without frames for `limitUs` the line is silent.
constexpr Gap gapOf(uint64_t beforeUs, uint64_t us, uint64_t lateUs, uint64_t limitUs = SilenceUs) {
  return us - beforeUs <= limitUs                                   ? Gap::Ordinary
         : lateUs >= SilenceUs && us - beforeUs <= limitUs + lateUs ? Gap::Late
                                                                    : Gap::Silent;
}

}  // namespace line
