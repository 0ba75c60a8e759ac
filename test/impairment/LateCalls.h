// A port that calls back, but late: other work holds the level of its calls.
#pragma once

#include "Conditions.h"

const std::vector<Condition> &lateCallLines();
