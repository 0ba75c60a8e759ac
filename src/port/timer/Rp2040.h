/// @file
/// An RP2040's alarms, for an SBus2Sensor and for DecodeSBusBackground.
// SlotTimer.h includes this.
#pragma once

#include <hardware/sync.h>
#include <hardware/timer.h>

namespace sbus {

// RP2040, RP2350 (arduino-pico): an alarm of the microsecond timer that nothing else uses. It polls the port, often
// while a frame's end is expected, at the lowest priority: other interrupts come first. It runs on the core that has
// called begin().
class SlotTimer : public NoSlotTimer {
 public:
  using Lock = FlagLock;
  static bool isLocked() { return Lock::isLocked; }

  // No interrupt comes between a look at the clock and the start bit.
  class CriticalSection {
   public:
    CriticalSection() : _interrupts(save_and_disable_interrupts()) {}
    ~CriticalSection() { restore_interrupts(_interrupts); }
    CriticalSection(const CriticalSection &) = delete;
    CriticalSection &operator=(const CriticalSection &) = delete;
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
  static void callIn(uint32_t us);
  // To what has interrupted one of the port's methods all of them return 0 (CoreMutex.cpp:47): the line would seem to
  // be silent, and the frame not to have ended.
  static bool isInPort(Stream &port) { return port.available() == 0 && port.availableForWrite() == 0; }
  // delayMicroseconds() sleeps, which no interrupt may (pico-sdk, src/common/pico_time/time.c:395).
  static void wait(uint32_t us) { busy_wait_us_32(us); }
  static bool send(const uint8_t *characters, size_t size);
};

}  // namespace sbus
