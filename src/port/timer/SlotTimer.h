/// @file
/// Sends a slot on time while loop() is busy, on the cores that can do that. Each core's timers are in a file of its
/// own.
#pragma once

#include <Arduino.h>
#include <stdint.h>

#include "../../sbus/Barrier.h"
#include "../../sbus2/FrameEnd.h"
#include "../Port.h"

namespace sbus {

// The time from the end of a wait until the start bit, us: 820 cycles of an AVR (simavr), a few us on other boards.
#if defined(SBUS_AVR)
constexpr uint32_t PollLead = 820 / (F_CPU / 1000000);
#else
constexpr uint32_t PollLead = 5;
#endif

// Does nothing: the sensor is polled from loop(). The timers of the cores inherit what they lack.
class NoSlotTimer {
 public:
  // The port calls back (CallbackPort.h); otherwise due() polls it.
  static constexpr bool HasCallback = false;

  // Keeps due() from reading the port, while this exists.
  struct Lock {
    Lock() {}
  };
  static bool isLocked() { return false; }

  // Keeps due() from running on another core while this exists. For code that due() may interrupt: a Lock would cost
  // answers there.
  using OtherCoreLock = Lock;

  // Held from reading the clock until the start bit goes out, on cores where other interrupts could come in between.
  struct CriticalSection {
    CriticalSection() {}
    // Returns when that is: `planned`, or later.
    uint32_t start(uint32_t planned) const { return planned; }
  };

  // Calls due(context) at the time given to callIn(). Returns false if it cannot.
  static bool start(Stream &, void (*)(void *), void *) { return false; }
  // Stops these calls.
  static void stop(void *) {}
  // Calls due() in `us` from now, or a little later.
  static void callIn(uint32_t) {}
  // Waits, in loop() or in due().
  static void wait(uint32_t us) { delayMicroseconds(static_cast<unsigned>(us)); }
  // Returns true if the last callback for half of the ring ran within a character's time.
  static bool cameAtOnce() { return false; }
  // Returns how many characters have come that were not read.
  static int waiting(Port &port) { return port.available(); }
  // Returns true if no character has come since there were `waiting`, and none comes in, if the port can tell.
  static bool isLineIdle(Port &port, int waiting) { return port.available() == waiting; }
  // Returns true if this has interrupted a method or the interrupt of `port`, which cannot be read here then.
  static bool isInPort(Stream &) { return false; }
  // Returns true if due() came so late that micros() may have stood still meanwhile.
  static bool isLate() { return false; }
  // The time between two polls from loop(), where it can be told whether micros() may have stood still.
  struct ClockCheck {
    static bool mayHaveStopped() { return false; }
  };
  // Sends at once. Returns false if it cannot.
  static bool send(const uint8_t *, size_t) { return false; }

  // Notes that a poll has found `found` bytes by the time `by`, us.
  static void polled(unsigned, uint32_t) {}
  // Returns when the last of them came; see sbus::frameEndOf(). `isTimed`: due() has polled, not loop().
  static FrameEnd endOf(bool, ReceiveNotice notice, unsigned found, uint32_t before, uint32_t by) {
    return sbus::frameEndOf(notice, found, before, by);
  }
};

// While this exists, as loop() reads what the timer's interrupt writes, the interrupt still sends what is due, but does
// not read the port.
class FlagLock {
 public:
  FlagLock() {
    isLocked = true;
    barrier();
  }
  ~FlagLock() {
    barrier();
    isLocked = false;
  }
  FlagLock(const FlagLock &) = delete;
  FlagLock &operator=(const FlagLock &) = delete;

  static volatile bool isLocked;  // defined by the timer that uses it
};

// The only sensor that a timer calls, and its port.
template <typename Port>
struct TimedSensor {
  void (*due)(void *);
  void *sensor;
  Port *port;  // null: the timer is free

  // Gives a sensor the timer, which is free.
  void claim(Port &sensorsPort, void (*callback)(void *), void *context) {
    sensor = context;
    due = callback;
    port = &sensorsPort;
  }
  // Returns true if this sensor has the timer.
  bool isOf(const void *context) const { return port != nullptr && sensor == context; }
  void call() const { due(sensor); }
};

}  // namespace sbus

#if defined(SBUS_STM32L0) && defined(TIM7)
#include "Stm32L0.h"
#elif defined(SBUS_AVR) && (defined(ICR4) || (defined(TIMER2_COMPB_vect) && defined(OCIE2B)))
#include "Avr.h"
#elif defined(SBUS_RP2040)
#include "Rp2040.h"
#elif defined(SBUS_ESP32)
#include "Esp32.h"
#elif defined(SBUS_IMXRT)
#include "Teensy.h"
#else
namespace sbus {
using SlotTimer = NoSlotTimer;
}
#endif
