/// @file
/// A Teensy 4's clock, for an SBus2Sensor that loop() polls, and what its timers may interrupt.
// SlotTimer.h includes this.
#pragma once

namespace sbus {

// No timer, but a counter that runs on while interrupts are off. micros() stops 1 ms after the newest interrupt of its
// own, and goes on from there (cores 7f107ee, teensy4/delay.c:118).
class SlotTimer : public NoSlotTimer {
 public:
  // One interrupt serves all IntervalTimers, with the highest of their priorities (teensy4/IntervalTimer.h:84). If the
  // sketch has one above the UART's, that may be the one that this has interrupted; both read the FIFO
  // (HardwareSerial.cpp:551, 622). So this only interrupts loop().
  static bool isInPort(Stream &) {
    constexpr uint32_t ReturnsToBase = 1 << 11;  // RETTOBASE: no other interrupt is active
    return (SCB_ICSR & ReturnsToBase) == 0;
  }

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
