/// @file
/// The AVR's: compare B of timer 2, in steps of 4 us. It polls the port, often while a frame's end is expected. tone()
/// and analogWrite() of its pins (Mega: 9, 10; Uno: 3, 11) do not work beside it. (Timer 0, of millis(), is a PWM:
/// there a new compare value waits for the overflow.)
#pragma once

#include <Arduino.h>
#include <stdint.h>

namespace sbus {

/// @cond  Not for sketches.

// There is one: a second sensor is polled from loop().
class SlotTimer {
 public:
  static constexpr bool HasCallback = false;

  // An AVR reads 32 bits one by one: while loop() does so, the interrupt sends what is due, but does not read the port.
  class Hold {
   public:
    Hold() { _held = true; }
    ~Hold() { _held = false; }
    Hold(const Hold &) = delete;
    Hold &operator=(const Hold &) = delete;
  };
  static bool isHeld() { return _held; }

  struct Alone {
    Alone() {}
    uint32_t start(uint32_t planned) const { return planned; }
  };

  static bool start(HardwareSerial &port, void (*received)(void *), void (*due)(void *), void *context);
  static bool start(Stream &, void (*)(void *), void (*)(void *), void *) { return false; }
  static void stop(void *context);
  static void at(uint32_t us);
  static void wait(uint32_t us) { delayMicroseconds(static_cast<unsigned>(us)); }
  static void send(const uint8_t *characters, size_t size);

 private:
  static volatile bool _held;
};

/// @endcond

}  // namespace sbus
