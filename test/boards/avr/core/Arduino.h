// The core's Arduino.h without its warnings, which are not ours. -isystem would do that, but avr-g++ takes what it
// finds there for C, and an empty list of parameters for an unknown list.
#pragma once

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wold-style-cast"
#include <cores/arduino/Arduino.h>
#pragma GCC diagnostic pop
