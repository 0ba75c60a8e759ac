/// @file
/// Sends a slot on time while loop() is busy, on the cores that can do that.
#pragma once

#include <Arduino.h>
#include <stdint.h>

#include "../sbus/Barrier.h"
#include "Port.h"
#include "../sbus2/FrameEnd.h"
#if defined(SBUS_RP2040)
#include <hardware/sync.h>
#include <hardware/timer.h>
#elif defined(SBUS_ESP32)
#include <esp_timer.h>
#include <freertos/FreeRTOS.h>
#include <freertos/semphr.h>

#include "../sbus2/FifoWatch.h"
#endif

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
  // The port calls back (ListeningPort.h); otherwise due() polls it.
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

// Holds an interrupt that polls: while loop() reads what the interrupt writes, it sends what is due, but does not read
// the port.
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

#if defined(SBUS_STM32L0) && defined(TIM7)
#define SBUS_SLOT_TIMER

// STM32L0: TIM7, which nothing in the core uses, calls when a slot is due. As on the other cores there is only one
// timer: a second sensor is polled from loop().
class SlotTimer : public NoSlotTimer {
 public:
  static constexpr bool HasCallback = true;

  using NoSlotTimer::start;
  static bool start(Uart &port, void (*due)(void *), void *context);
  static void stop(void *context);
  static void callIn(uint32_t us);
  static bool cameAtOnce();
  static bool isLineIdle(Port &, int);
  static bool send(const uint8_t *characters, size_t size);
};

#elif defined(SBUS_AVR) && defined(TIMER2_COMPB_vect) && defined(OCIE2B)
#define SBUS_SLOT_TIMER

// AVR: compare B of timer 2, in steps of 4 us. It polls the port, often while a frame's end is expected. tone() and
// analogWrite() of its pins (Mega: 9, 10; Uno: 3, 11) do not work beside it. (Timer 0, of millis(), is a PWM: there a
// new compare value waits for the overflow.)
class SlotTimer : public NoSlotTimer {
 public:
  using Lock = FlagLock;  // an AVR reads 32 bits one by one
  static bool isLocked() { return Lock::isLocked; }

  using NoSlotTimer::start;
  static bool start(HardwareSerial &port, void (*due)(void *), void *context);
  static void stop(void *context);
  static void callIn(uint32_t us);
  static bool isLate() { return _isLate; }
  static bool send(const uint8_t *characters, size_t size);
  static void tick();  // the interrupt

 private:
  static bool _isLate;
};

#elif defined(SBUS_RP2040)
#define SBUS_SLOT_TIMER

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
  // delayMicroseconds() sleeps, which no interrupt may (pico-sdk, src/common/pico_time/time.c:395).
  static void wait(uint32_t us) { busy_wait_us_32(us); }
  static bool send(const uint8_t *characters, size_t size);
};

#elif defined(SBUS_ESP32)
#define SBUS_SLOT_TIMER

// ESP32 (arduino-esp32 2.0 and later): a one-shot of esp_timer. Its task polls the port and watches the UART's FIFO,
// often while a frame's end is expected. Tasks of a higher priority (WiFi) and writes to flash delay that task, and
// cost answers. A second sensor does not answer.
class SlotTimer : public NoSlotTimer {
 public:
  // The task is on another core than loop(): each waits for the other, and loop() up to 1.5 ms while a frame's end is
  // expected.
  class Lock {
   public:
    Lock() : _taken(_mutex) {
      if (_taken != nullptr) {
        xSemaphoreTake(_taken, portMAX_DELAY);
      }
    }
    ~Lock() {
      if (_taken != nullptr) {
        xSemaphoreGive(_taken);
      }
    }
    Lock(const Lock &) = delete;
    Lock &operator=(const Lock &) = delete;

   private:
    const SemaphoreHandle_t _taken;
  };
  using OtherCoreLock = Lock;

  // No interrupt, and no write to flash, comes between a look at the clock and the start bit; but the cache may lack
  // what lies in flash. So send() looks once more, and the time of the start is the latest that it allows.
  class CriticalSection {
   public:
    CriticalSection() { portENTER_CRITICAL(&_lock); }
    ~CriticalSection() { portEXIT_CRITICAL(&_lock); }
    CriticalSection(const CriticalSection &) = delete;
    CriticalSection &operator=(const CriticalSection &) = delete;
    uint32_t start(uint32_t planned) const {
      _looked = clock();
      const uint32_t latest = _looked + LongestSend;
      return static_cast<int32_t>(latest - planned) > 0 ? latest : planned;
    }
  };

  using NoSlotTimer::start;
  static bool start(HardwareSerial &port, void (*due)(void *), void *context);
  static void stop(void *context);
  static void callIn(uint32_t us);
  static int waiting(Port &);
  static bool isLineIdle(Port &port, int waiting);
  static bool send(const uint8_t *characters, size_t size);

  static void polled(unsigned found, uint32_t by);
  static FrameEnd endOf(bool isTimed, ReceiveNotice, unsigned found, uint32_t, uint32_t by) {
    return isTimed && found != 0 ? _watch.end() : FifoWatch::unknown(by);
  }

 private:
  static constexpr uint32_t LongestSend = 30;  // us
  static uint32_t clock() { return static_cast<uint32_t>(esp_timer_get_time()); }

  static SemaphoreHandle_t _mutex;
  static portMUX_TYPE _lock;
  static uint32_t _looked;
  static FifoWatch _watch;
};

#elif defined(SBUS_TEENSY4)

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

#else

using SlotTimer = NoSlotTimer;

#endif

}  // namespace sbus
