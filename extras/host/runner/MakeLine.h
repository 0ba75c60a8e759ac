// Opens the line for the board's port, according to the options.
#pragma once

#include <memory>

#include "Options.h"
#include "line/Line.h"

namespace host {

// Opens the line, and prints its name to standard error; a silent line if the options have none. Throws
// std::runtime_error.
std::unique_ptr<line::Line> makeLine(const Options &options);

}  // namespace host
