/// @file
/// The STM32L0's TIM7, for an SBus2Sensor.
// SlotTimer.h includes this.
#pragma once

#define SBUS_SLOT_TIMER

namespace sbus {

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

}  // namespace sbus
