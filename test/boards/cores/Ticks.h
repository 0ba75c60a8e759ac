// What calls each millisecond: on a Teensy an IntervalTimer, on a SAMD SysTick, which asks for PendSV.
#pragma once

namespace sim {

struct Ticks {
  unsigned free = 4;       // IntervalTimers of a Teensy
  bool isPending = false;  // a SAMD's PendSV
  unsigned priority = 0;   // PendSV's, after a reset
};
extern Ticks ticks;

// Switches the board on.
void startTicks();

}  // namespace sim
