// millis() and micros() of the unit programs: both come from one counter, cut to 32 bits each, as on the board.
#pragma once

#include <cstdint>

extern uint64_t fakeMicros;

// How long the sketch's clock has stood still: what it shows lags behind `fakeMicros` by this.
extern uint64_t fakeStoodStillUs;

// Where micros() and millis() wrap.
constexpr uint64_t MicrosWrap = uint64_t{1} << 32;         // us: 71 minutes and 35 seconds
constexpr uint64_t MillisWrap = (uint64_t{1} << 32) * 1000;  // us: 49 days and 17 hours
