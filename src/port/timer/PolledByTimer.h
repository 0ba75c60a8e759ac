/// @file
/// Polls decoders each millisecond, whatever loop() does, on the cores that can do that.
#pragma once

#include <Arduino.h>
#include <stdint.h>

#include "../../sbus/Barrier.h"
#include "../Port.h"
#include "SlotTimer.h"

#if (defined(SBUS_AVR) && defined(TIMER0_COMPB_vect) && defined(TIMSK0)) || defined(SBUS_RP2040) || \
    defined(SBUS_ESP32) || defined(SBUS_TEENSY) || defined(SBUS_SAMD)
#define SBUS_POLLING_TIMER

namespace sbus {

// A decoder that is polled each millisecond while loop() does other things.
class PolledByTimer {
 public:
  using Poll = bool(PolledByTimer &);

  PolledByTimer() {}
  PolledByTimer(const PolledByTimer &) = delete;
  PolledByTimer &operator=(const PolledByTimer &) = delete;

  // Polls all of them; the core's timer calls it. Returns false if it is to be called again soon.
  static bool pollDecoders();

  // Keeps the others from polling, while it exists. A poll that was due meanwhile is made at the end: otherwise a
  // sketch that calls methods all the time would leave the port full.
#if defined(SBUS_ESP32)
  struct Lock : TaskLock {
    explicit Lock(const PolledByTimer &) {}
    ~Lock();
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
    static_assert(canPoll(static_cast<Class *>(nullptr)),
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
#if defined(SBUS_RP2040)
  static constexpr bool canPoll(const SerialUART *) { return true; }
#else
  static constexpr bool canPoll(const HardwareSerial *) { return true; }
  template <typename Port>
  static constexpr auto canPoll(const Port *) -> decltype(typename Port::PortKind(), bool()) {
    return true;
  }
#endif
  static constexpr bool canPoll(const void *) { return false; }

  // Returns false if the port could not be read: pollDecoders() is to be called again soon.
  template <typename Decoder>
  static bool poll(PolledByTimer &self) {
    Decoder &decoder = static_cast<Decoder &>(self);
    if (SlotTimer::isInPort(decoder._port.stream())) {
      return false;
    }
    decoder.pollAll(false);
    return true;
  }

  // The core's timer, which calls pollDecoders(): in the core's file. Returns false if none is free.
  static bool startTimer();
  static void stopTimer();

  static PolledByTimer *first;

  PolledByTimer *_next = nullptr;
  Poll *_poll = nullptr;
  volatile bool _isLocked = false;
  volatile bool _wasDue = false;
};

}  // namespace sbus

#endif
