// Arduino.h without the macros that the standard headers do not survive. To be included before any other header that
// includes Arduino.h.
#pragma once

#include <Arduino.h>

#undef min
#undef max
#undef abs
#undef round
#undef bit
