// Class Servo for a board that receives on an SBusPin, like Arduino's library of that name, whose interrupt takes so
// long that frames are missed: up to eight servos, one pulse after the other, every 20 ms, by compare unit A of timer
// 1. The SBusPin must be open, as it starts the timer.
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

  // Called by the timer's interrupt, Ahead before an edge is due, with interrupts on: makes the edge in time. Of the
  // other interrupts only the SBusPin's may come meanwhile, which takes 4 us, and none within the last 4 us: an edge of
  // S.Bus can wait for 7 us. An edge that is late all the same moves the next one, too, so that no pulse is short.
  static void elapsed() {
    Servo *const ends = current < count ? servos[current] : nullptr;
    current = static_cast<uint8_t>(ends != nullptr ? current + 1 : 0);
    Servo *const begins = current < count ? servos[current] : nullptr;
    volatile uint8_t none;
    volatile uint8_t *const low = ends != nullptr ? ends->_port : &none;
    volatile uint8_t *const high = begins != nullptr ? begins->_port : &none;
    const uint8_t lowMask = static_cast<uint8_t>(~(ends != nullptr ? ends->_mask : 0));
    const uint8_t highMask = begins != nullptr ? begins->_mask : 0;
    noInterrupts();
    const uint8_t timer = TIMSK0, serial = UCSR0B;
    TIMSK0 = 0;
    UCSR0B = static_cast<uint8_t>(serial & ~(_BV(RXCIE0) | _BV(UDRIE0)));
    while (left() > Quiet) {
      interrupts();
      __asm__ __volatile__("nop\n nop\n");  // an instruction runs before any interrupt
      noInterrupts();
    }
    while (left() > 0) {
    }
    *low &= lowMask;
    *high |= highMask;
    const uint16_t now = TCNT1;
    interrupts();
    const uint16_t start = static_cast<uint16_t>(now - due) < Late ? due : now;
    if (begins == nullptr) {
      round = static_cast<uint16_t>(round + Period);
    }
    noInterrupts();
    arm(begins != nullptr ? static_cast<uint16_t>(start + begins->_ticks) : round);
    TIMSK0 = timer;
    UCSR0B = serial;
    interrupts();
  }

 private:
  static constexpr uint8_t Most = 8;
  static constexpr uint8_t TicksPerUs = 2;
  static constexpr uint16_t Period = 20000u * TicksPerUs;
  static constexpr uint16_t Ahead = 40 * TicksPerUs;  // longer than the interrupts that may run just then
  static constexpr int16_t Quiet = 4 * TicksPerUs;
  static constexpr uint16_t Late = 2 * TicksPerUs;

  static void arm(uint16_t time) {
    due = time;
    OCR1A = static_cast<uint16_t>(time - Ahead);
  }
  // Returns the ticks until the edge is due. Interrupts are off.
  static int16_t left() { return static_cast<int16_t>(due - TCNT1); }

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

ISR(TIMER1_COMPA_vect, ISR_NOBLOCK) { Servo::elapsed(); }
