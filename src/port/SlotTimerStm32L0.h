/// @file
/// The STM32L0's: the port calls back at PendSV level when bytes have come, and TIM7, which nothing in the core uses,
/// calls back when a slot is due.
#pragma once

#include <Arduino.h>
#include <stdint.h>

namespace sbus {

/// @cond  Not for sketches.

// There is one: a second sensor is polled from loop().
class SlotTimer {
 public:
  static constexpr bool HasCallback = true;
  struct Hold {
    Hold() {}
  };
  static bool isHeld() { return false; }

  struct Alone {
    Alone() {}
    uint32_t start(uint32_t planned) const { return planned; }
  };

  static bool start(Uart &port, void (*received)(void *), void (*due)(void *), void *context);
  template <typename Port>
  static bool start(Port &, void (*)(void *), void (*)(void *), void *) {
    return false;
  }
  static void stop(void *context);

  static void at(uint32_t us);
  static void wait(uint32_t us) { delayMicroseconds(static_cast<unsigned>(us)); }

  // From its own buffer: what Uart::write(buffer, size) takes is cut in two with a pause where its ring ends
  // (Uart.cpp:207).
  static void send(const uint8_t *characters, size_t size);
};

/// @endcond

}  // namespace sbus
