// What is said at the end, on standard error.
#pragma once

#include "Board.h"
#include "Options.h"

namespace host {

void printReport(Board &board, const Options &options);

}  // namespace host
