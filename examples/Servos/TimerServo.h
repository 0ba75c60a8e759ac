// Class Servo for a board that receives on a SBusPin, like Arduino's library of that name, whose interrupt takes so long
// that frames are missed: up to eight servos, one pulse after the other, every 20 ms, by compare unit A of timer 1. The
// SBusPin must be open, as it starts the timer.
#pragma once

#include <Arduino.h>

class Servo {
 public:
  // Sets the length of the next pulses in us, clamped to 544..2400 as by Arduino's library. It may precede attach().
  void writeMicroseconds(int us) {
    const uint16_t ticks = static_cast<uint16_t>(us < 544 ? 544 : us > 2400 ? 2400 : us) * TicksPerUs;
    noInterrupts();  // its two bytes belong together
    _ticks = ticks;
    interrupts();
  }

  // Starts pulses of 1500 us. Returns false if there are eight servos already, or no such pin.
  bool attach(int pin) {
    if (_port != nullptr || count == Most || pin < 0 || pin >= NUM_DIGITAL_PINS) {
      return _port != nullptr;
    }
    const uint8_t number = static_cast<uint8_t>(pin);
    pinMode(number, OUTPUT);
    _mask = digitalPinToBitMask(number);
    _port = portOutputRegister(digitalPinToPort(number));
    noInterrupts();
    servos[count] = this;
    count++;
    if (count == 1) {
      round = static_cast<uint16_t>(TCNT1 + Period);
      arm(round);
      TIFR1 = _BV(OCF1A);
      TIMSK1 |= _BV(OCIE1A);
    }
    interrupts();
    return true;
  }

  // Called by the timer's interrupt, Ahead before an edge is due, and with interrupts on: makes it in time, and arms the
  // next. Interrupts are off for the last 3 us only, as an edge of S.Bus may wait for 8 us.
  static void elapsed() {
    Servo *const ends = current < count ? servos[current] : nullptr;
    const uint8_t next = static_cast<uint8_t>(ends != nullptr ? current + 1 : 0);
    Servo *const begins = next < count ? servos[next] : nullptr;
    const uint8_t low = ends != nullptr ? static_cast<uint8_t>(~ends->_mask) : 0, high = begins != nullptr ? begins->_mask : 0;
    while (!isNear()) {
    }
    while (isBefore(0)) {
    }
    if (ends != nullptr) {
      *ends->_port &= low;
    }
    if (begins != nullptr) {
      *begins->_port |= high;
      arm(static_cast<uint16_t>(TCNT1 + begins->_ticks));
    } else {
      round = static_cast<uint16_t>(round + Period);
      arm(round);
    }
    current = next;
    interrupts();
  }

 private:
  static constexpr uint8_t Most = 8;
  static constexpr uint8_t TicksPerUs = 2;
  static constexpr uint16_t Period = 20000u * TicksPerUs;
  static constexpr uint16_t Ahead = 16 * TicksPerUs;  // longer than the other interrupts that may come just then
  static constexpr uint16_t Near = 3 * TicksPerUs;

  static void arm(uint16_t time) {
    due = time;
    OCR1A = static_cast<uint16_t>(time - Ahead);
  }
  static bool isBefore(uint16_t near) { return static_cast<int16_t>(due - TCNT1) > static_cast<int16_t>(near); }
  // Turns interrupts off if the edge is near.
  static bool isNear() {
    noInterrupts();
    if (isBefore(Near)) {
      interrupts();
      return false;
    }
    return true;
  }

  static Servo *servos[Most];
  static uint8_t count;
  static uint8_t current;  // whose pulse is on; `count` or more: none
  static uint16_t due;     // ticks, the next edge
  static uint16_t round;   // ticks, the first edge of this round or the next

  volatile uint8_t *_port = nullptr;  // null: not attached
  uint8_t _mask = 0;
  volatile uint16_t _ticks = 1500 * TicksPerUs;
};

Servo *Servo::servos[Servo::Most];
uint8_t Servo::count = 0;
uint8_t Servo::current = Servo::Most;
uint16_t Servo::due;
uint16_t Servo::round;

ISR(TIMER1_COMPA_vect, ISR_NOBLOCK) {
  Servo::elapsed();
}
