// A stand-in for Arduino's Servo library, which Debian does not have: a pulse every 20 ms at each of four pins, one
// after the other, timed by timer 5 as that library does it on a Mega, or timer 1 as on other boards
// (src/avr/ServoTimers.h).
#pragma once

#include <Arduino.h>
#include <util/atomic.h>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wold-style-cast"  // of the core's macros

#if defined(TCCR5A)
#define SERVO_TIMER(name, letter) name##5##letter
#define SERVO_INTERRUPT TIMER5_COMPB_vect
#else
#define SERVO_TIMER(name, letter) name##1##letter
#define SERVO_INTERRUPT TIMER1_COMPB_vect
#endif

class Servo {
 public:
  Servo() : _number(count++) {}

  // Starts the pulses.
  void attach(int pin) {
    const uint8_t number = static_cast<uint8_t>(pin);
    pinMode(number, OUTPUT);
    ATOMIC_BLOCK(ATOMIC_RESTORESTATE) {
      pulses[_number].mask = digitalPinToBitMask(number);
      pulses[_number].port = portOutputRegister(digitalPinToPort(number));
      if (SERVO_TIMER(TIMSK, ) == 0) {
        SERVO_TIMER(TCCR, A) = 0;
        SERVO_TIMER(TCCR, B) =
            _BV(SERVO_TIMER(WGM, 2)) | _BV(SERVO_TIMER(CS, 1));  // up to OCRnA, and again; every 8 cycles
        SERVO_TIMER(TCNT, ) = 0;
        SERVO_TIMER(OCR, A) = Count * Slot - 1;
        SERVO_TIMER(OCR, B) = edge - Ahead;
        SERVO_TIMER(TIMSK, ) = _BV(SERVO_TIMER(OCIE, B));
      }
    }
  }

  // Takes effect with the next pulse.
  void writeMicroseconds(int us) {
    const uint16_t ticks = static_cast<uint16_t>(constrain(us, 544, 2400)) * TicksPerUs;
    ATOMIC_BLOCK(ATOMIC_RESTORESTATE) { pulses[_number].ticks = ticks; }
  }

  // Called by the interrupt of the timer: makes the edge, and sets the time of the next.
  static void next() {
    const Pulse &pulse = pulses[current];
    while (SERVO_TIMER(TCNT, ) < edge) {
    }
    if (pulse.port != nullptr) {
      *pulse.port = static_cast<uint8_t>(rises ? *pulse.port | pulse.mask : *pulse.port & ~pulse.mask);
    }
    current = rises ? current : static_cast<uint8_t>((current + 1) % Count);
    edge = Gap + current * Slot + (rises ? pulse.ticks : 0);
    rises = !rises;
    SERVO_TIMER(OCR, B) = edge - Ahead;
  }

 private:
  static constexpr uint8_t Count = 4;
  static constexpr uint16_t TicksPerUs = 2;            // the timer counts 16 MHz / 8
  static constexpr uint16_t Slot = 5000 * TicksPerUs;  // of each servo
  // Before each pulse, so that none begins right after the end of one of the simulated receiver's frames: there a
  // sketch may have read neither that frame nor the one before.
  static constexpr uint16_t Gap = 1000 * TicksPerUs;
  // The interrupt comes this much before an edge, and waits for it: other interrupts, each shorter than that, do not
  // move the edge, as they do with the real library.
  static constexpr uint16_t Ahead = 24 * TicksPerUs;

  struct Pulse {
    volatile uint8_t *port;  // null: not attached
    uint8_t mask;
    uint16_t ticks;
  };

  static Pulse pulses[Count];
  static uint8_t count;
  static uint8_t current;  // whose edge comes next,
  static bool rises;       // which one,
  static uint16_t edge;    // and when

  const uint8_t _number;
};

Servo::Pulse Servo::pulses[Servo::Count];
uint8_t Servo::count = 0;
uint8_t Servo::current = 0;
bool Servo::rises = true;
uint16_t Servo::edge = Servo::Gap;

ISR(SERVO_INTERRUPT) { Servo::next(); }

#pragma GCC diagnostic pop
