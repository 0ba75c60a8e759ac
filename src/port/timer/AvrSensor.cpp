#include "SlotTimer.h"

#if defined(SBUS_AVR) && defined(SBUS_SLOT_TIMER)

// A register or bit of the timer, such as SBUS_TIMER(TCCR, A).
#if defined(ICR4)
#define SBUS_TIMER(name, suffix) name##4##suffix
#else
#define SBUS_TIMER(name, suffix) name##2##suffix
#endif

namespace sbus {

namespace {

#if defined(ICR4)
using Count = uint16_t;
constexpr uint8_t Clock = _BV(CS41) | _BV(CS40);
#else
using Count = uint8_t;
constexpr uint8_t Clock = _BV(CS22);
#endif

constexpr uint32_t Divider = 64;  // of the clock: a tick is 4 us at 16 MHz, 5.3 us at 12 MHz
constexpr uint8_t DelayMin = 3;   // ticks
constexpr uint8_t DelayMax = 150;
constexpr uint8_t LatenessMax = 64;  // ticks: micros() stops from 256 on

TimedSensor<HardwareSerial> timed;
uint8_t ticks;         // until the next call
uint8_t modeA, modeB;  // what the core had set: the PWM of analogWrite()

// Reads UCSRnA of a port, for which the port has no public method.
struct Status : HardwareSerial {
  static const volatile uint8_t *of(const HardwareSerial &port) { return port.*(&Status::_ucsra); }
};

}  // namespace

volatile bool FlagLock::isLocked = false;
bool SlotTimer::_isLate = false;

bool SlotTimer::start(HardwareSerial &port, void (*due)(void *), void *context) {
  if (timed.port != nullptr) {
    return timed.isOf(context);
  }
  modeA = SBUS_TIMER(TCCR, A);
  modeB = SBUS_TIMER(TCCR, B);
  timed.claim(port, due, context);
  SBUS_TIMER(TCCR, A) = 0;
  SBUS_TIMER(TCCR, B) = Clock;
#if defined(ICR4)
  OCR4B = TCNT4 + DelayMin;  // 16 bits would take 0.3 s to come round
#endif
  SBUS_TIMER(TIMSK, ) |= _BV(SBUS_TIMER(OCIE, B));
  return true;
}

void SlotTimer::stop(void *context) {
  if (timed.isOf(context)) {
    SBUS_TIMER(TIMSK, ) &= static_cast<uint8_t>(~_BV(SBUS_TIMER(OCIE, B)));
    SBUS_TIMER(TCCR, A) = modeA;
    SBUS_TIMER(TCCR, B) = modeB;
    timed.port = nullptr;
  }
}

// Called by due() only, in the interrupt.
void SlotTimer::callIn(uint32_t us) {
  const uint32_t wanted = us * (F_CPU / 1000000) / Divider;
  ticks = static_cast<uint8_t>(wanted < DelayMin ? DelayMin : wanted > DelayMax ? DelayMax : wanted);
}

// The port's own interrupt would write the third character while loop() may have disabled interrupts. This waits 120 us
// for it, with interrupts, of which none may take longer: then the characters are cut short, and do not come apart.
bool SlotTimer::send(const uint8_t *characters, size_t size) {
  const volatile uint8_t *const status = Status::of(*timed.port);
  for (size_t i = 0; i < size; i++) {
    const uint8_t from = static_cast<uint8_t>(SBUS_TIMER(TCNT, ));
    while ((*status & _BV(UDRE0)) == 0 && static_cast<uint8_t>(SBUS_TIMER(TCNT, ) - from) < LatenessMax) {
    }
    cli();
    const bool isApart = i > 0 && (*status & _BV(TXC0)) != 0;
    if (!isApart) {
      timed.port->write(characters[i]);
    }
    sei();
    if (isApart) {
      break;
    }
  }
  return true;
}

// Others may interrupt it, since characters come every 120 us; it does not interrupt itself. Compare A shows that it
// comes very late.
void SlotTimer::tick() {
  SBUS_TIMER(TIMSK, ) &= static_cast<uint8_t>(~_BV(SBUS_TIMER(OCIE, B)));
  _isLate = (SBUS_TIMER(TIFR, ) & _BV(SBUS_TIMER(OCF, A))) != 0;
  sei();
  timed.call();
  cli();
  SBUS_TIMER(OCR, B) = static_cast<Count>(SBUS_TIMER(TCNT, ) + ticks);
  SBUS_TIMER(OCR, A) = static_cast<Count>(SBUS_TIMER(OCR, B) + LatenessMax);
  SBUS_TIMER(TIFR, ) = _BV(SBUS_TIMER(OCF, B)) | _BV(SBUS_TIMER(OCF, A));
  SBUS_TIMER(TIMSK, ) |= _BV(SBUS_TIMER(OCIE, B));
}

}  // namespace sbus

// With `dot_a_linkage` it is linked only into sketches that have an SBus2Sensor.
ISR(SBUS_TIMER(TIMER, _COMPB_vect)) { sbus::SlotTimer::tick(); }

#endif
