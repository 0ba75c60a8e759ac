// What millis() and micros() answer in the unit programs.
#pragma once

#include <cstdint>

extern uint64_t fakeMicros;
