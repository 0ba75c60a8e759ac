/// @file
/// A Teensy 4's clock, for an SBus2Sensor that loop() polls.
// SlotTimer.h includes this.
#pragma once

namespace sbus {

// No timer, but a counter that runs on while interrupts are off. micros() stops 1 ms after the newest interrupt of its
// own, and goes on from there (cores 7f107ee, teensy4/delay.c:118).
class SlotTimer : public NoSlotTimer {
 public:
  class ClockCheck {
   public:
    bool mayHaveStopped() {
      const uint32_t now = ARM_DWT_CYCCNT;
      const uint32_t cycles = now - _newest;
      _newest = now;
      return cycles > F_CPU_ACTUAL / 1000 - F_CPU_ACTUAL / 10000;
    }

   private:
    uint32_t _newest = 0;
  };
};

}  // namespace sbus
