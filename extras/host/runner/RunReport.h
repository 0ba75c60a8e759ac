// Prints the report at the end, on standard error.
#pragma once

#include "Options.h"
#include "board/Board.h"

namespace host {

void printReport(Board &board, const Options &options);

}  // namespace host
