// Draws CH1 to CH4 of a flight as an SVG within its report, whose style it has.
#pragma once

#include <string>

#include "line/report/FlightLog.h"

namespace line {

// Of a flight that has frames.
std::string curvesOf(const FlightLog &flight);

}  // namespace line
