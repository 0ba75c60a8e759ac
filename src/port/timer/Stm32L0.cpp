#include "SlotTimer.h"

#if defined(SBUS_STM32L0) && defined(SBUS_SLOT_TIMER)

#include <stm32l0_timer.h>

#include "../DmaSender.h"

namespace sbus {

namespace {

constexpr unsigned Priority = 1;      // as the UARTs' interrupts: neither interrupts the other
constexpr uint32_t DelayMax = 60000;  // the timer has 16 bits

TimedSensor<Uart> timed;
stm32l0_timer_t timer;

void elapsed(void *, uint32_t) { timed.call(); }

}  // namespace

// The prescaler counts from the first elapsed period on (stm32l0_timer.c:294 sets no UG): so the first period is too
// short, and due() comes too early.
bool SlotTimer::start(Uart &port, void (*due)(void *), void *context) {
  if (timed.port != nullptr || !stm32l0_timer_create(&timer, STM32L0_TIMER_INSTANCE_TIM7, Priority, 0)) {
    return timed.isOf(context);
  }
  if (!stm32l0_timer_enable(&timer, stm32l0_timer_clock(&timer) / 1000000 - 1, 0, elapsed, nullptr,
                            STM32L0_TIMER_EVENT_PERIOD)) {
    stm32l0_timer_destroy(&timer);
    return false;
  }
  timed.claim(port, due, context);
  return true;
}

void SlotTimer::stop(void *context) {
  if (timed.isOf(context)) {
    stm32l0_timer_stop(&timer);
    stm32l0_timer_disable(&timer);
    stm32l0_timer_destroy(&timer);
    timed.port = nullptr;
  }
}

void SlotTimer::callIn(uint32_t us) { stm32l0_timer_start(&timer, us < 1 ? 1 : us > DelayMax ? DelayMax : us, true); }

bool SlotTimer::cameAtOnce() { return DmaSender::cameAtOnce(timed.port); }

bool SlotTimer::isLineIdle(Port &, int) { return !DmaSender::hears(timed.port); }

bool SlotTimer::send(const uint8_t *characters, size_t size) { return DmaSender::send(timed.port, characters, size); }

}  // namespace sbus

#endif
