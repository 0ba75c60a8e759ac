/// @file
/// The SlotTimer of an RP2040 or RP2350 (arduino-pico): an alarm of the microsecond timer that nothing else uses. It
/// polls the port, often while a frame's end is expected, at the lowest priority: other interrupts come first.
#pragma once

#include <Arduino.h>
#include <hardware/sync.h>
#include <hardware/timer.h>
#include <stdint.h>

namespace sbus {

// There is only one: a second sensor is polled from loop(). Its interrupt runs on the core that has called begin().
class SlotTimer : public NoSlotTimer {
 public:
  using Lock = FlagLock;
  static bool isLocked() { return Lock::isLocked; }

  // No interrupt comes between a look at the clock and the start bit.
  class Alone {
   public:
    Alone() : _interrupts(save_and_disable_interrupts()) {}
    ~Alone() { restore_interrupts(_interrupts); }
    Alone(const Alone &) = delete;
    Alone &operator=(const Alone &) = delete;
    uint32_t start(uint32_t planned) const {
      const uint32_t now = time_us_32();
      return static_cast<int32_t>(now - planned) > 0 ? now : planned;
    }

   private:
    const uint32_t _interrupts;
  };

  using NoSlotTimer::start;
  static bool start(SerialUART &port, void (*due)(void *), void *context);
  static void stop(void *context);
  static void at(uint32_t us);
  // delayMicroseconds() sleeps, which no interrupt may (pico-sdk, src/common/pico_time/time.c:395).
  static void wait(uint32_t us) { busy_wait_us_32(us); }
  static bool send(const uint8_t *characters, size_t size);
};

}  // namespace sbus
