// A stand-in for Arduino's Servo library, which Debian does not have: a pulse every 20 ms at each of four pins, one
// after the other, timed by timer 5 as that library does it on a Mega.
#pragma once

#include <Arduino.h>
#include <util/atomic.h>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wold-style-cast"  // of the core's macros

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
      if (TIMSK5 == 0) {
        TCCR5A = 0;
        TCCR5B = _BV(WGM52) | _BV(CS51);  // up to OCR5A, and again; every 8 cycles
        TCNT5 = 0;
        OCR5A = Count * Slot - 1;
        OCR5B = edge - Ahead;
        TIMSK5 = _BV(OCIE5B);
      }
    }
  }

  // Takes effect with the next pulse.
  void writeMicroseconds(int us) {
    const uint16_t ticks = static_cast<uint16_t>(constrain(us, 544, 2400)) * TicksPerUs;
    ATOMIC_BLOCK(ATOMIC_RESTORESTATE) {
      pulses[_number].ticks = ticks;
    }
  }

  // Called by the interrupt of timer 5: makes the edge, and sets the time of the next.
  static void next() {
    const Pulse &pulse = pulses[current];
    while (TCNT5 < edge) {
    }
    if (pulse.port != nullptr) {
      *pulse.port = static_cast<uint8_t>(rises ? *pulse.port | pulse.mask : *pulse.port & ~pulse.mask);
    }
    current = rises ? current : static_cast<uint8_t>((current + 1) % Count);
    edge = Gap + current * Slot + (rises ? pulse.ticks : 0);
    rises = !rises;
    OCR5B = edge - Ahead;
  }

 private:
  static constexpr uint8_t Count = 4;
  static constexpr uint16_t TicksPerUs = 2;            // timer 5 counts 16 MHz / 8
  static constexpr uint16_t Slot = 5000 * TicksPerUs;  // of each servo
  // Before each pulse, so that none begins right after the end of one of the simulated receiver's frames: there a
  // sketch may have read neither that frame nor the one before.
  static constexpr uint16_t Gap = 1000 * TicksPerUs;
  // The interrupt comes this much before an edge, and waits for it: other interrupts, each shorter than that, do not move
  // the edge, as they do with the real library.
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

ISR(TIMER5_COMPB_vect) {
  Servo::next();
}

#pragma GCC diagnostic pop
