/// @file
/// The Ticker of an AVR: compare B of timer 0, which counts millis(). It comes once in 256 counts of 64 cycles, 1.024
/// ms at 16 MHz, wherever analogWrite() puts it: no timer is taken.
#pragma once

#include <Arduino.h>

namespace sbus {

class Ticker : public AnyTicker {
 public:
  // An interrupt could come between the two bytes of a pointer.
  class Change {
   public:
    Change() : _state(SREG) { cli(); }
    ~Change() { SREG = _state; }
    Change(const Change &) = delete;
    Change &operator=(const Change &) = delete;

   private:
    const uint8_t _state;
  };

  static bool start();
  static void stop();
};

}  // namespace sbus
