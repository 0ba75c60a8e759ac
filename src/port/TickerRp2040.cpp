#include "Ticker.h"

#if defined(SBUS_RP2040)

#include <hardware/irq.h>
#include <hardware/timer.h>
#include <pico.h>

namespace sbus {

namespace {

constexpr uint32_t Period = 1000;  // us
constexpr uint32_t Soonest = 20;   // us: loop() goes on meanwhile

bool isRunning = false;
unsigned alarm, core;
uint32_t next = Period;  // us, until the next call

// If the time has already passed, the alarm is not set: then it tries again.
void arm() {
  while (hardware_alarm_set_target(alarm, from_us_since_boot(time_us_64() + next))) {
  }
}

// A time that changes from call to call: otherwise the interrupt could stay in step with a loop() that is in a method
// of the port each time.
void elapsed(unsigned) {
  next = PolledByTimer::tickAll() ? Period : next < 2 * Soonest ? next + 1 : Soonest;
  arm();
}

}  // namespace

// Below the UART's interrupt: above it, it would wait forever for the mutex that this one holds (SerialUART.cpp:352 and
// 518).
bool Ticker::start() {
  if (isRunning) {
    return core == get_core_num();
  }
  const int free = hardware_alarm_claim_unused(false);
  if (free < 0) {
    return false;
  }
  isRunning = true;
  alarm = static_cast<unsigned>(free);
  core = get_core_num();
  hardware_alarm_set_callback(alarm, elapsed);
  irq_set_priority(hardware_alarm_get_irq_num(alarm), PICO_LOWEST_IRQ_PRIORITY);
  arm();
  return true;
}

void Ticker::stop() {
  if (!isRunning) {
    return;
  }
  hardware_alarm_cancel(alarm);
  hardware_alarm_set_callback(alarm, nullptr);
  irq_set_priority(hardware_alarm_get_irq_num(alarm), PICO_DEFAULT_IRQ_PRIORITY);
  hardware_alarm_unclaim(alarm);
  isRunning = false;
}

}  // namespace sbus

#endif
