// Lines with more than frames: telemetry, stray characters, a loop() with delays, a loose connector.
#pragma once

#include "Conditions.h"

// No frame is damaged. None is wrong, and none is missed, except frames that allow a false sync and that a stray
// character touches.
const std::vector<Condition> &companyLines();
