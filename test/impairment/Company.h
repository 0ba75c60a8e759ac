// Lines with more than frames: telemetry, stray characters, a loop() with delays, a loose connector.
#pragma once

#include "Conditions.h"

const std::vector<Condition> &companyLines();
