/// @file
/// An alarm of an RP2040's microsecond timer.
#pragma once

#include "Core.h"

#if defined(SBUS_RP2040)

#include <hardware/irq.h>
#include <hardware/timer.h>
#include <pico.h>

namespace sbus {

// An alarm that nothing else uses.
class Alarm {
 public:
  // Takes one, whose interrupt calls `elapsed` on the core that calls this. Returns false if none is free.
  //
  // Below the UART's interrupt: above it, it would wait forever for the mutex that this one holds (SerialUART.cpp:352
  // and 518).
  bool claim(hardware_alarm_callback_t elapsed) {
    const int free = hardware_alarm_claim_unused(false);
    if (free < 0) {
      return false;
    }
    _number = static_cast<unsigned>(free);
    hardware_alarm_set_callback(_number, elapsed);
    irq_set_priority(hardware_alarm_get_irq_num(_number), PICO_LOWEST_IRQ_PRIORITY);
    return true;
  }

  // Calls once, in `us`. If the time has already passed, the alarm is not set: then this tries again.
  void arm(uint32_t us) const {
    while (hardware_alarm_set_target(_number, from_us_since_boot(time_us_64() + us))) {
    }
  }

  // Gives it back.
  void release() const {
    hardware_alarm_cancel(_number);
    hardware_alarm_set_callback(_number, nullptr);
    irq_set_priority(hardware_alarm_get_irq_num(_number), PICO_DEFAULT_IRQ_PRIORITY);
    hardware_alarm_unclaim(_number);
  }

 private:
  unsigned _number = 0;
};

}  // namespace sbus

#endif
