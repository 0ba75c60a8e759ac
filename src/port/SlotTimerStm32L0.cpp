#include "SlotTimer.h"

#if defined(SERIAL_SBUS) && defined(TIM7)

#include <stm32l0_timer.h>

#include "DmaSender.h"

namespace sbus {

namespace {

constexpr unsigned Priority = 1;       // as the UARTs' interrupts: neither interrupts the other
constexpr uint32_t LongestUs = 60000;  // the timer has 16 bits

stm32l0_timer_t timer;
Uart *sender = nullptr;  // null: free
void *sensor;
void (*dueCallback)(void *);

void elapsed(void *, uint32_t) {
  dueCallback(sensor);
}

}  // namespace

// The prescaler counts from the first elapsed period on (stm32l0_timer.c:294 sets no UG): so the first period is too
// short, and due() comes too early.
bool SlotTimer::start(Uart &port, void (*due)(void *), void *context) {
  if (sender != nullptr) {
    return sensor == context;
  }
  if (!stm32l0_timer_create(&timer, STM32L0_TIMER_INSTANCE_TIM7, Priority, 0)) {
    return false;
  }
  if (!stm32l0_timer_enable(&timer, stm32l0_timer_clock(&timer) / 1000000 - 1, 0, elapsed, nullptr,
                            STM32L0_TIMER_EVENT_PERIOD)) {
    stm32l0_timer_destroy(&timer);
    return false;
  }
  sender = &port;
  sensor = context;
  dueCallback = due;
  return true;
}

void SlotTimer::stop(void *context) {
  if (sender == nullptr || sensor != context) {
    return;
  }
  stm32l0_timer_stop(&timer);
  stm32l0_timer_disable(&timer);
  stm32l0_timer_destroy(&timer);
  sender = nullptr;
}

void SlotTimer::at(uint32_t us) {
  stm32l0_timer_start(&timer, us < 1 ? 1 : us > LongestUs ? LongestUs : us, true);
}

bool SlotTimer::isFresh() {
  return DmaSender::isFresh(sender);
}

bool SlotTimer::isQuiet(Port &, int) {
  return !DmaSender::hears(sender);
}

bool SlotTimer::send(const uint8_t *characters, size_t size) {
  return DmaSender::send(sender, characters, size);
}

}  // namespace sbus

#endif
