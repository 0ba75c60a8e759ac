/// @file
/// Polls decoders each millisecond, whatever loop() does: one file for each core that can do that.
#pragma once

#include <Arduino.h>
#include <stdint.h>

#include "../sbus/Barrier.h"
#include "Port.h"

namespace sbus {

// The defaults of each core's Ticker.
class AnyTicker {
 public:
  // Exists while the list of decoders changes.
  struct Change {
    Change() {}
  };

  // Returns true if tickAll() may call the methods of such a port.
  static constexpr bool canPoll(const HardwareSerial *) { return true; }
  static constexpr bool canPoll(const void *) { return false; }

  // Returns true if this port can be read now.
  static bool canRead(Port &) { return true; }
};

}  // namespace sbus

#if defined(SBUS_AVR)
#if defined(TIMER0_COMPB_vect) && defined(TIMSK0)
#define SBUS_TICKER
#include "TickerAvr.h"
#endif
#elif defined(SBUS_RP2040)
#define SBUS_TICKER
#include "TickerRp2040.h"
#elif defined(SBUS_ESP32)
#define SBUS_TICKER
#include "TickerEsp32.h"
#elif defined(SBUS_TEENSY) || defined(SBUS_SAMD)
#define SBUS_TICKER
#define SBUS_PLAIN_TICKER
#endif

#if defined(SBUS_TICKER)

namespace sbus {

#if defined(SBUS_PLAIN_TICKER)
// A Teensy: an IntervalTimer, at the lowest priority. A SAMD: the core's tick of a millisecond, SysTick, asks for
// PendSV, which polls: no timer is taken.
class Ticker : public AnyTicker {
 public:
  static bool start();
  static void stop();
};
#endif

// A decoder that is polled each millisecond while loop() does other things.
class PolledByTimer {
 public:
  using Poll = bool(PolledByTimer &);

  PolledByTimer() {}
  PolledByTimer(const PolledByTimer &) = delete;
  PolledByTimer &operator=(const PolledByTimer &) = delete;

  // Polls all of them; the core's timer calls it. Returns false if it is to be called again soon.
  static bool tickAll();

  // Keeps the others from polling, while it exists. A poll that was due meanwhile is made at the end: otherwise a
  // sketch that calls methods all the time would leave the port full.
#if defined(SBUS_ESP32)
  class Lock {
   public:
    explicit Lock(const PolledByTimer &) {}
    ~Lock() {
      if (Ticker::wasDue) {
        Ticker::wasDue = false;
        tickAll();
      }
    }
    Lock(const Lock &) = delete;
    Lock &operator=(const Lock &) = delete;

   private:
    const Ticker::Change _lock;
  };
#else
  class Lock {
   public:
    explicit Lock(const PolledByTimer &decoder) : _decoder(const_cast<PolledByTimer &>(decoder)) { set(true); }
    ~Lock() {
      set(false);
      while (_decoder._wasDue) {
        set(true);
        _decoder._wasDue = false;
        _decoder._poll(_decoder);
        set(false);
      }
    }
    Lock(const Lock &) = delete;
    Lock &operator=(const Lock &) = delete;

   private:
    void set(bool isLocked) {
      barrier();
      _decoder._isLocked = isLocked;
      barrier();
    }
    PolledByTimer &_decoder;
  };
#endif

 protected:
  template <typename Class>
  static void check() {
    static_assert(Ticker::canPoll(static_cast<Class *>(nullptr)),
                  "An interrupt cannot read this port. Use DecodeSBus: extras/docs/interrupts.md");
  }

  // From now on `decoder`, this object, is polled each millisecond, if a timer is free. Call stopPolling() first.
  template <typename Decoder>
  void startPolling(Decoder &) {
    startPolling(poll<Decoder>);
  }
  // Likewise; `callback` polls.
  void startPolling(Poll *callback);
  // Stops these calls.
  void stopPolling();

 private:
  // Returns false if the port could not be read: tickAll() is to be called again soon.
  template <typename Decoder>
  static bool poll(PolledByTimer &self) {
    Decoder &decoder = static_cast<Decoder &>(self);
    if (!Ticker::canRead(decoder._port)) {
      return false;
    }
    decoder.pollAll(false);
    return true;
  }

  static PolledByTimer *first;

  PolledByTimer *_next = nullptr;
  Poll *_poll = nullptr;
  volatile bool _isLocked = false;
  volatile bool _wasDue = false;
};

}  // namespace sbus

#endif
