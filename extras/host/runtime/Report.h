// What is said at the end, on standard error.
#pragma once

#include "Board.h"

namespace host {

// `on`: the number of the port with the line.
void printReport(Board &board, int on);

}  // namespace host
