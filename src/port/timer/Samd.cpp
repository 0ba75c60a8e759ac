#include "PolledByTimer.h"

#if defined(SBUS_SAMD)

namespace sbus {

namespace {

volatile bool isRunning = false;

}  // namespace

// The core's tick of a millisecond, SysTick, asks for PendSV, which polls: no timer is taken. The lowest priority, as
// the SERCOMs have it (SERCOM.h, SERCOM_NVIC_PRIORITY): neither interrupts the other. SysTick's is above them
// (wiring.c:66), and PendSV's is the highest of all after a reset.
bool PolledByTimer::startTimer() {
  NVIC_SetPriority(PendSV_IRQn, (1 << __NVIC_PRIO_BITS) - 1);
  isRunning = true;
  return true;
}

void PolledByTimer::stopTimer() { isRunning = false; }

}  // namespace sbus

extern "C" {

// The core calls this each millisecond (cortex_handlers.c:172). 0: millis() goes on.
int sysTickHook() {
  if (sbus::isRunning) {
    SCB->ICSR = SCB_ICSR_PENDSVSET_Msk;
  }
  return 0;
}

// Weak in the core, as sysTickHook() is. (Its pendSVHook() is never called.)
void PendSV_Handler() { sbus::PolledByTimer::pollDecoders(); }
}

#endif
