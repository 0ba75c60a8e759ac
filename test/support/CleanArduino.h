// Arduino.h without the macros that break the standard headers. Include it before any other header that includes
// Arduino.h.
#pragma once

#include <Arduino.h>

#undef min
#undef max
#undef abs
#undef round
#undef bit
