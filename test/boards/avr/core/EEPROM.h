// The core's EEPROM.h, whose warnings are not ours; see Arduino.h.
#pragma once

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wold-style-cast"
#pragma GCC diagnostic ignored "-Wshadow"
#include <libraries/EEPROM/src/EEPROM.h>
#pragma GCC diagnostic pop
