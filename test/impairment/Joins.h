// A receiver that is plugged in, or begins to listen, while frames come: does it join parts of two frames?
#pragma once

#include "Conditions.h"

// Each line is one join, with 30 frames that allow a false sync at any place.
const std::vector<Condition> &joinLines();
