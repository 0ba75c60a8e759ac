/// @file
/// The SlotTimer of an STM32L0: TIM7, which nothing in the core uses, calls when a slot is due.
#pragma once

#include <Arduino.h>
#include <stdint.h>

namespace sbus {

// There is only one: a second sensor is polled from loop().
class SlotTimer : public NoSlotTimer {
 public:
  static constexpr bool HasCallback = true;

  using NoSlotTimer::start;
  static bool start(Uart &port, void (*due)(void *), void *context);
  static void stop(void *context);
  static void at(uint32_t us);

  static bool isFresh();
  static bool isQuiet(Port &, int);
  static bool send(const uint8_t *characters, size_t size);
};

}  // namespace sbus
