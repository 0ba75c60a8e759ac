#include "Ticker.h"

#if defined(SBUS_TICKER) && defined(SBUS_AVR)

namespace sbus {

// 0, as after a reset, would be the time of the interrupt that counts millis().
bool Ticker::start() {
  if (OCR0B == 0) {
    OCR0B = 128;
  }
  TIMSK0 |= _BV(OCIE0B);
  return true;
}

void Ticker::stop() {
  TIMSK0 &= static_cast<uint8_t>(~_BV(OCIE0B));
}

}  // namespace sbus

// Other interrupts may come, since characters come every 120 us; it does not interrupt itself. With `dot_a_linkage` it
// is linked only into sketches that listen in the background.
ISR(TIMER0_COMPB_vect) {
  TIMSK0 &= static_cast<uint8_t>(~_BV(OCIE0B));
  sei();
  sbus::PolledByTimer::tickAll();
  cli();
  TIMSK0 |= _BV(OCIE0B);
}

#endif
