// Puts a Ppm out at the pin ppmTimer::Pin. On an AVR, Grasshopper, Pico (arduino-pico) and ESP32 a timer makes the
// edges, whatever loop() does. On other boards poll() makes them: nine times a frame it waits for an edge and a pulse,
// for up to 0.8 ms, and if a loop() takes longer than 0.5 ms a channel is longer by the excess.
#pragma once

#include <Arduino.h>

#include "Ppm.h"

#if defined(ARDUINO_ARCH_stm32l0) && defined(TIM7)
#include <stm32l0_timer.h>
#elif defined(ARDUINO_ARCH_RP2040) && !defined(ARDUINO_ARCH_MBED)
#include <hardware/timer.h>
#elif defined(ESP32)
#include <esp_timer.h>
#endif

namespace ppmTimer {

static Ppm *source;
static bool isInverted;
static Ppm::Part next = {false, Ppm::Rest};  // it begins at the next edge

inline bool nextLevel() { return next.isPulse != isInverted; }

#if defined(__AVR__) && defined(COM1A1)

// The compare unit of timer 1 makes the edges, at its own pin: an interrupt that is held up moves none. Servo and
// analogWrite() of this timer's pins do not work beside it.
#if defined(__AVR_ATmega2560__) || defined(__AVR_ATmega1280__)
const uint8_t Pin = 11;
#else
const uint8_t Pin = 9;
#endif
static_assert(F_CPU % 8000000 == 0, "Timer 1 counts whole ticks per us at 8 or 16 MHz. Choose such a clock.");
const uint16_t TicksPerUs = F_CPU / 8000000;

// Sets what happens to the pin at the next edge.
inline void prepare() { TCCR1A = static_cast<uint8_t>(nextLevel() ? _BV(COM1A1) | _BV(COM1A0) : _BV(COM1A1)); }

// The timer may also capture an S.Bus line (SBusPin), whose interrupt would come between the two bytes of its
// registers.
inline void start() {
  noInterrupts();
  TCCR1B = static_cast<uint8_t>((TCCR1B & _BV(ICES1)) | _BV(CS11));
  prepare();
  TCCR1C = _BV(FOC1A);  // at once
  OCR1A = static_cast<uint16_t>(TCNT1 + next.us * TicksPerUs);
  TIFR1 = _BV(OCF1A);
  TIMSK1 |= _BV(OCIE1A);
  interrupts();
  pinMode(Pin, OUTPUT);
}

inline void elapsed() {
  noInterrupts();
  OCR1A = static_cast<uint16_t>(OCR1A + next.us * TicksPerUs);
  interrupts();
  next = source->next();
  prepare();
}

inline void poll() {}

#else

const uint8_t Pin = 2;

inline void makeEdge() { digitalWrite(Pin, nextLevel() ? HIGH : LOW); }

#if defined(ARDUINO_ARCH_stm32l0) && defined(TIM7)

// Timer 7 runs on from edge to edge: an interrupt that is late moves its own edge only.
static stm32l0_timer_t timer;

inline void elapsed(void *, uint32_t) {
  makeEdge();
  stm32l0_timer_period(&timer, next.us - 1u, false);
  next = source->next();
}

inline void start() {
  makeEdge();
  pinMode(Pin, OUTPUT);
  stm32l0_timer_create(&timer, STM32L0_TIMER_INSTANCE_TIM7, 0, 0);  // above the ports' interrupts
  stm32l0_timer_enable(&timer, stm32l0_timer_clock(&timer) / 1000000 - 1, 0, elapsed, nullptr,
                       STM32L0_TIMER_EVENT_PERIOD);
  stm32l0_timer_start(&timer, next.us - 1u, false);
}

inline void poll() {}

#else

static uint32_t due;  // us, the next edge

// Makes the edge that is due. Returns in how many us the next one is.
inline uint32_t step() {
  // us; if it is later, the next part counts from now: no part is cut short to catch up
  const uint32_t LatenessMax = 50;
  makeEdge();
  const uint32_t now = micros();
  due = (now - due <= LatenessMax ? due : now) + next.us;
  next = source->next();
  return due - now;
}

#if defined(ARDUINO_ARCH_RP2040) && !defined(ARDUINO_ARCH_MBED)

inline void elapsed(unsigned alarm) {
  const uint32_t us = step();
  while (hardware_alarm_set_target(alarm, from_us_since_boot(time_us_64() + us))) {  // one that has passed is not set
  }
}

inline void startTimer() {
  const unsigned alarm = static_cast<unsigned>(hardware_alarm_claim_unused(true));
  hardware_alarm_set_callback(alarm, elapsed);
  hardware_alarm_set_target(alarm, from_us_since_boot(time_us_64() + next.us));
}

inline void poll() {}

#elif defined(ESP32)

static esp_timer_handle_t timer;

// Runs in the timers' task: Wi-Fi, and writes to flash, make it late.
inline void elapsed(void *) { esp_timer_start_once(timer, step()); }

inline void startTimer() {
  esp_timer_create_args_t settings = {};
  settings.callback = elapsed;
  settings.name = "ppm";
  esp_timer_create(&settings, &timer);
  esp_timer_start_once(timer, next.us);
}

inline void poll() {}

#else

inline void startTimer() {}

inline void poll() {
  const int32_t Near = 500;  // us
  while (static_cast<int32_t>(due - micros()) < Near) {
    while (static_cast<int32_t>(due - micros()) > 0) {
    }
    step();
  }
}

#endif

inline void start() {
  makeEdge();
  pinMode(Pin, OUTPUT);
  due = micros() + next.us;
  startTimer();
}

#endif
#endif

// Makes the pin an output, LOW at rest, or HIGH if `inverted`. Call it once.
inline void begin(Ppm &ppm, bool inverted) {
  source = &ppm;
  isInverted = inverted;
  start();
}

}  // namespace ppmTimer

#if defined(__AVR__) && defined(COM1A1)
ISR(TIMER1_COMPA_vect, ISR_NOBLOCK) {  // the next one comes 0.3 ms later
  ppmTimer::elapsed();
}
#endif
