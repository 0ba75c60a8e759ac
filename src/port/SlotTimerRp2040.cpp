#include "SlotTimer.h"

#if defined(SBUS_RP2040)

#include <hardware/irq.h>

namespace sbus {

namespace {

constexpr uint32_t Soonest = 10;  // us: loop() goes on meanwhile

unsigned alarm;
SerialUART *sender = nullptr;  // null: free
void *sensor;
void (*dueCallback)(void *);
uint32_t next;  // us, until the next call

// Returns a time that changes from call to call: otherwise the interrupt could stay in step with a loop() that is in a
// method of the port each time.
uint32_t soon() {
  return next >= Soonest && next < 2 * Soonest ? next + 1 : Soonest;
}

// If the time has already passed, the alarm is not set: then it tries again.
void arm() {
  while (hardware_alarm_set_target(alarm, from_us_since_boot(time_us_64() + next))) {
  }
}

// If the sketch was interrupted within a method of the port, all of them return 0 here (CoreMutex.cpp:47): a poll would
// find nothing, and seem to know that the frame has not ended. So it comes again.
void elapsed(unsigned) {
  if (sender->availableForWrite() > 0) {
    dueCallback(sensor);
  } else {
    next = soon();
  }
  arm();
}

}  // namespace

volatile bool FlagLock::isLocked = false;

// Below the UART's interrupt: above it, it would wait forever for the mutex that this one holds (SerialUART.cpp:352 and
// 518).
bool SlotTimer::start(SerialUART &port, void (*due)(void *), void *context) {
  if (sender != nullptr) {
    return sensor == context;
  }
  const int free = hardware_alarm_claim_unused(false);
  if (free < 0) {
    return false;
  }
  alarm = static_cast<unsigned>(free);
  sender = &port;
  sensor = context;
  dueCallback = due;
  next = Soonest;
  hardware_alarm_set_callback(alarm, elapsed);
  irq_set_priority(hardware_alarm_get_irq_num(alarm), PICO_LOWEST_IRQ_PRIORITY);
  arm();
  return true;
}

void SlotTimer::stop(void *context) {
  if (sender == nullptr || sensor != context) {
    return;
  }
  hardware_alarm_cancel(alarm);
  hardware_alarm_set_callback(alarm, nullptr);
  irq_set_priority(hardware_alarm_get_irq_num(alarm), PICO_DEFAULT_IRQ_PRIORITY);
  hardware_alarm_unclaim(alarm);
  sender = nullptr;
}

// Called by due() only, in the interrupt.
void SlotTimer::at(uint32_t us) {
  next = us < Soonest ? soon() : us;
}

// The UART's FIFO takes 32.
bool SlotTimer::send(const uint8_t *characters, size_t size) {
  return sender->write(characters, size) == size;
}

}  // namespace sbus

#endif
