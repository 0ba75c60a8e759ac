#include "PolledByTimer.h"

#if defined(SBUS_POLLING_TIMER) && defined(SBUS_AVR)

namespace sbus {

// Compare B of timer 0, which counts millis(). It comes once in 256 counts of 64 cycles, 1.024 ms at 16 MHz, wherever
// analogWrite() puts it: no timer is taken. 0, as after a reset, would be the time of the interrupt of millis().
bool PolledByTimer::startTimer() {
  if (OCR0B == 0) {
    OCR0B = 128;
  }
  TIMSK0 |= _BV(OCIE0B);
  return true;
}

void PolledByTimer::stopTimer() { TIMSK0 &= static_cast<uint8_t>(~_BV(OCIE0B)); }

}  // namespace sbus

// Other interrupts may come, since characters come every 120 us; it does not interrupt itself. With `dot_a_linkage` it
// is linked only into sketches that listen in the background.
ISR(TIMER0_COMPB_vect) {
  TIMSK0 &= static_cast<uint8_t>(~_BV(OCIE0B));
  sei();
  sbus::PolledByTimer::pollDecoders();
  cli();
  TIMSK0 |= _BV(OCIE0B);
}

#endif
