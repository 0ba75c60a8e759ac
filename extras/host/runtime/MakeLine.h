// The line that the options ask for.
#pragma once

#include <memory>

#include "Line.h"
#include "Options.h"
#include "Wire.h"

namespace host {

Wire makeWire(const Options &options);

// Says on standard error which line it is; one with nothing on it if the options want none. Throws std::runtime_error.
std::unique_ptr<Line> makeLine(const Options &options, const Wire &wire);

}  // namespace host
