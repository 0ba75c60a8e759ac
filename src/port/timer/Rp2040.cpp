#include "../Core.h"

#if defined(SBUS_RP2040)

#include <hardware/irq.h>
#include <pico.h>

#include "PolledByTimer.h"
#include "SlotTimer.h"

namespace sbus {

namespace {

// An alarm that nothing else uses. Its interrupt runs on the core that has claimed it.
class Alarm {
 public:
  // Takes one, and calls `elapsed` in `us` for the first time. Returns false if none is free.
  //
  // Below the UART's interrupt: above it, it would wait forever for the mutex that this one holds (SerialUART.cpp:352
  // and 518).
  bool claim(hardware_alarm_callback_t elapsed, uint32_t us) {
    const int free = hardware_alarm_claim_unused(false);
    if (free < 0) {
      return false;
    }
    _number = static_cast<unsigned>(free);
    hardware_alarm_set_callback(_number, elapsed);
    irq_set_priority(hardware_alarm_get_irq_num(_number), PICO_LOWEST_IRQ_PRIORITY);
    next = us;
    arm();
    return true;
  }

  // Calls once more, in `next`. If the time has already passed, the alarm is not set: then this tries again.
  void arm() const {
    while (hardware_alarm_set_target(_number, from_us_since_boot(time_us_64() + next))) {
    }
  }

  // Gives it back.
  void release() const {
    hardware_alarm_cancel(_number);
    hardware_alarm_set_callback(_number, nullptr);
    irq_set_priority(hardware_alarm_get_irq_num(_number), PICO_DEFAULT_IRQ_PRIORITY);
    hardware_alarm_unclaim(_number);
  }

  // Sets `next` to a short time that changes from call to call: otherwise the interrupt could stay in step with a
  // loop() that is in a method of the port each time.
  void callSoon() { next = next >= DelayMin && next < 2 * DelayMin ? next + 1 : DelayMin; }

  static constexpr uint32_t DelayMin = 10;  // us: loop() goes on meanwhile
  uint32_t next;                            // us, until the next call

 private:
  unsigned _number;
};

}  // namespace

// ---- DecodeSBusBackground: decoders of the core that has not called begin() first are not polled

namespace {

constexpr uint32_t Period = 1000;  // us

bool isRunning = false;
unsigned core;
Alarm ticks;

void tick(unsigned) {
  if (PolledByTimer::pollDecoders()) {
    ticks.next = Period;
  } else {
    ticks.callSoon();
  }
  ticks.arm();
}

}  // namespace

bool PolledByTimer::startTimer() {
  if (isRunning) {
    return core == get_core_num();
  }
  isRunning = ticks.claim(tick, Period);
  core = get_core_num();
  return isRunning;
}

void PolledByTimer::stopTimer() {
  if (isRunning) {
    ticks.release();
    isRunning = false;
  }
}

// ---- SBus2Sensor

namespace {

TimedSensor<SerialUART> timed;
Alarm slots;

void slot(unsigned) {
  if (SlotTimer::isInPort(*timed.port)) {
    slots.callSoon();
  } else {
    timed.call();
  }
  slots.arm();
}

}  // namespace

volatile bool FlagLock::isLocked = false;

bool SlotTimer::start(SerialUART &port, void (*due)(void *), void *context) {
  if (timed.port != nullptr) {
    return timed.isOf(context);
  }
  timed.claim(port, due, context);
  if (!slots.claim(slot, Alarm::DelayMin)) {
    timed.port = nullptr;
  }
  return timed.port != nullptr;
}

void SlotTimer::stop(void *context) {
  if (timed.isOf(context)) {
    slots.release();
    timed.port = nullptr;
  }
}

// Called by due() only, in the interrupt.
void SlotTimer::callIn(uint32_t us) {
  if (us < Alarm::DelayMin) {
    slots.callSoon();
  } else {
    slots.next = us;
  }
}

// The UART's FIFO takes 32.
bool SlotTimer::send(const uint8_t *characters, size_t size) { return timed.port->write(characters, size) == size; }

}  // namespace sbus

#endif
