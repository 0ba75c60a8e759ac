// Opens the line at the board's port that the options ask for.
#pragma once

#include <memory>

#include "Options.h"
#include "line/Line.h"

namespace host {

// Opens the line, and names it on standard error; a line with nothing on it if the options have none. Throws
// std::runtime_error.
std::unique_ptr<line::Line> makeLine(const Options &options);

}  // namespace host
