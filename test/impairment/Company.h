// Lines on which a receiver is not alone: telemetry, stray characters, a loop() with delays, a connector that is loose.
#pragma once

#include "Conditions.h"

// No frame is damaged. None is wrong, and none is missed, except frames with a second reading that a stray character
// touches.
const std::vector<Condition> &companyLines();
