// Arduino.h of the stand-ins: one core, CORE, and what sketches expect of all.
#pragma once

#include <stdlib.h>
#include <string.h>

#include CORE

// The port that a receiver is on.
#if !defined(SBUS_PORT)
#define SBUS_PORT Serial1
extern Console Serial;
#endif

void setup();
void loop();
uint32_t millis();  // 32 bits, as on all boards
uint32_t micros();
void delay(unsigned long ms);
void delayMicroseconds(unsigned us);
void yield();

#define LOW 0
#define HIGH 1
#define INPUT 0
#define OUTPUT 1
#define LED_BUILTIN 13
#define PROGMEM
inline void pinMode(uint32_t, uint32_t) {}
void digitalWrite(uint32_t pin, uint32_t level);
inline int digitalRead(uint32_t) { return LOW; }
#define CHANGE 2
#define digitalPinToInterrupt(pin) (pin)
inline void attachInterrupt(uint32_t, void (*)(), int) {}
inline void noInterrupts() {}
inline void interrupts() {}
static const uint8_t A0 = 14;
#if defined(ESP32)
static const uint8_t A3 = 39;  // variants/esp32/pins_arduino.h has no A1 and A2
#else
static const uint8_t A1 = 15;
#endif
inline int analogRead(uint32_t) { return 512; }
