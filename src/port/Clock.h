/// @file
/// Tells how old a frame is, also on a core whose micros() stands still while the board sleeps.
#pragma once

#include <Arduino.h>
#include <stdint.h>

#include "../sbus/Link.h"
#include "Core.h"
#if defined(SBUS_STM32L0)
#include "../sbus/SleepClock.h"
#endif

namespace sbus {

#if defined(SBUS_STM32L0)

// On an STM32L0 micros() is SysTick, which is slow in STM32L0.sleep() and stops in deepsleep(); millis() is the RTC
// (cores/arduino/delay.c:32, 41; stm32l0_system.c:872, 1660, 1733). The core tells before it sleeps (:1631), and only
// from then on millis() is asked, which costs 200 cycles each time.
class Clock {
 public:
  // Starts now. The object must live until stop().
  void start() {
    _sleeps.reset();
    tell(sleeps);
  }
  // Told twice, core 0.0.10 would add the object to its list (its stm32l0_system.c:1381).
  void stop() {
    if (_notice.callback != nullptr) {
      tell(nullptr);
      _notice.callback = nullptr;
    }
  }
  ~Clock() { stop(); }  // the core must not call an object that is gone

  // Takes a frame that is complete now, with its FrameFinder::frameTime(). Returns true if the board has slept since
  // the frame before: SleepClock::hasSlept(). `time` is earlier than micros(), so it is asked for first.
  bool noteFrame(uint32_t time) {
    if (!_sleeps.hasEverSlept()) {
      return false;
    }
    const uint32_t ms = millis();
    const bool slept = _sleeps.hasSlept(time, ms) && _sleeps.hasSlept(micros(), ms);
    _sleeps.frame(time, ms);
    return slept;
  }

  // Returns the age, us, of a frame with this frameTime(): the newest, or one that came near it.
  uint32_t ageOf(uint32_t time) const {
    if (!_sleeps.hasEverSlept()) {
      return micros() - time;
    }
    const uint32_t ms = millis();
    return _sleeps.age(time, micros(), ms);
  }

  // Returns the time, us, as a clock counts that never stands still, in steps of 1 ms or more.
  static uint32_t now() { return millis() * 1000; }

 private:
  void tell(stm32l0_system_callback_t callback) {
#if defined(STM32L0_SYSTEM_NOTIFY_SLEEP)
    stm32l0_system_unregister(&_notice);
    if (callback != nullptr) {
      stm32l0_system_register(&_notice, callback, this, STM32L0_SYSTEM_NOTIFY_SLEEP);
    }
#else  // core 0.0.10, which the Boards Manager installs (its stm32l0_system.c:1354, 1469)
    stm32l0_system_notify(&_notice, callback, this, STM32L0_SYSTEM_EVENT_SLEEP);
#endif
  }

  // Called by the core, in loop()'s context.
  static void sleeps(void *object, uint32_t) {
    const uint32_t ms = millis();
    static_cast<Clock *>(object)->_sleeps.beforeSleep(micros(), ms);
  }

  stm32l0_system_notify_t _notice = {};
  SleepClock _sleeps;
};

#else

// On all other cores that receive S.Bus either both clocks run while the board sleeps or neither does
// (extras/docs/sleep.md).
class Clock {
 public:
  void start() {}
  void stop() {}
  static constexpr bool noteFrame(uint32_t) { return false; }
  static uint32_t ageOf(uint32_t time) { return micros() - time + ClockStep; }
  static uint32_t now() { return micros(); }
};

#endif

// A link, and the clock that its ages come from. (A base class without members takes no byte.)
struct ClockedLink : Link, Clock {};

}  // namespace sbus
