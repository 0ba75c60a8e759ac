// The line at the board's port that the options ask for.
#pragma once

#include <memory>

#include "Options.h"
#include "line/Line.h"

namespace host {

// Says on standard error which line it is; one with nothing on it if the options want none. Throws std::runtime_error.
std::unique_ptr<line::Line> makeLine(const Options &options);

}  // namespace host
