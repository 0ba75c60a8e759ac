// A line without damage, as the board hands it over, and what its frames cost.
#pragma once

#include <cstdint>

#include "Cost.h"

struct CleanLine {
  uint16_t centre;  // of the sticks: 992 has 0F in the payload, 1024 has not
  uint32_t periodUs;
  uint32_t loopUs;
};

constexpr unsigned MeasuredFrames = 96;  // the driver's ring begins anew after 32

// Of MeasuredFrames frames, after some more. The receiver is called after a call of loop() if bytes wait.
Cost costOursOf(const CleanLine &line);
Cost costPapersOf(const CleanLine &line);
