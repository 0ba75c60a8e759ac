#include "Servo.h"

#include <Arduino.h>
#include <util/atomic.h>

#pragma GCC diagnostic ignored "-Wold-style-cast"  // of the core's macros

namespace {

constexpr uint16_t TicksPerUs = 2;                // timer 5 counts 16 MHz / 8,
constexpr uint16_t Top = 20000 * TicksPerUs - 1;  // and begins anew after 20 ms
constexpr uint16_t Gap = 50 * TicksPerUs;         // in front of each pulse: an edge has an interrupt of its own
// The interrupt comes so much before an edge, and waits for it: other interrupts, each shorter than that, do not move
// the edge, as they do with the real library.
constexpr uint16_t Ahead = 24 * TicksPerUs;

struct Channel {
  volatile uint8_t *port;  // null: not attached
  uint8_t mask;
  uint16_t ticks;  // of its pulse
};

Channel channels[ServoMax];
uint8_t count = 0;    // of the Servo objects
uint8_t current = 0;  // whose edge comes next,
bool rises = true;    // which one,
uint16_t edge = Gap;  // and when

void start() {
  TCCR5A = 0;
  TCCR5B = 0;
  TCNT5 = 0;
  OCR5A = Top;
  OCR5B = edge - Ahead;
  TIMSK5 = _BV(OCIE5B);
  TCCR5B = _BV(WGM52) | _BV(CS51);  // up to OCR5A, and again; every 8 cycles
}

inline void put(const Channel &channel, bool high) {
  if (channel.port != nullptr) {
    *channel.port = static_cast<uint8_t>(high ? *channel.port | channel.mask : *channel.port & ~channel.mask);
  }
}

inline void proceed() {
  if (rises) {
    edge += channels[current].ticks;
    rises = false;
    return;
  }
  current++;
  if (current == count) {
    current = 0;
    edge = 0;
  }
  edge += Gap;
  rises = true;
}

}  // namespace

ISR(TIMER5_COMPB_vect) {
  const Channel &channel = channels[current];
  const bool high = rises;
  const uint16_t when = edge;
  while (TCNT5 < when) {
  }
  put(channel, high);
  proceed();
  OCR5B = edge - Ahead;
}

Servo::Servo() : _number(count) {
  if (_number < ServoMax) {
    channels[_number].ticks = 1500 * TicksPerUs;
    count++;
  }
}

uint8_t Servo::attach(int pin) {
  if (_number >= ServoMax) {
    return UINT8_MAX;
  }
  digitalWrite(static_cast<uint8_t>(pin), LOW);
  pinMode(static_cast<uint8_t>(pin), OUTPUT);
  const uint8_t pinNumber = static_cast<uint8_t>(pin);
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) {
    channels[_number].mask = digitalPinToBitMask(pinNumber);
    channels[_number].port = portOutputRegister(digitalPinToPort(pinNumber));
    if ((TIMSK5 & _BV(OCIE5B)) == 0) {
      start();
    }
  }
  return _number;
}

void Servo::detach() {
  if (attached()) {
    ATOMIC_BLOCK(ATOMIC_RESTORESTATE) {
      put(channels[_number], false);
      channels[_number].port = nullptr;
    }
  }
}

bool Servo::attached() const {
  return _number < ServoMax && channels[_number].port != nullptr;
}

void Servo::writeMicroseconds(int us) {
  if (_number < ServoMax) {
    const uint16_t ticks = static_cast<uint16_t>(constrain(us, 544, 2400)) * TicksPerUs;
    ATOMIC_BLOCK(ATOMIC_RESTORESTATE) {
      channels[_number].ticks = ticks;
    }
  }
}

int Servo::readMicroseconds() const {
  return _number < ServoMax ? static_cast<int>(channels[_number].ticks / TicksPerUs) : 0;
}
