// Arduino.h for the host: declares on a PC what sketches and libraries may expect from the board's core.
#pragma once

#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

// By this name the core is known (its boards.txt: build.arch).
#define ARDUINO_ARCH_stm32l0

#include "HardwareSerial.h"
#include "PinDescription.h"
#include "Uart.h"
#include "UsbSerial.h"
#include "WCharacter.h"
#include "WString.h"
#include "avr/dtostrf.h"  // AVR, ESP32 and Pico have dtostrf() without it
#include "avr/pgmspace.h"
#include "binary.h"
#include "itoa.h"

typedef bool boolean;
typedef uint8_t byte;
typedef uint16_t word;
#include "WMath.h"  // makes word() a macro

// The sketch.
void setup();
void loop();

// Time. The board's unsigned long has 32 bits, the host's 64. With uint32_t these wrap like the board's, and so do
// their differences, as long as the sketch keeps them in uint32_t.
uint32_t millis();
uint32_t micros();
void delay(unsigned long ms);
void delayMicroseconds(unsigned int us);
void yield();

// Hold back, and release, the callbacks of Uart::onReceive() and attachInterrupt().
void noInterrupts();
void interrupts();

// Pins. Nothing is connected: an output reads as written, INPUT_PULLUP reads HIGH, other inputs LOW. With --pulses,
// pins 2..5 receive servo pulses. The report lists what the sketch did at each pin. analogRead() returns half of the
// reference.
#define LOW 0x0
#define HIGH 0x1
#define INPUT 0x0
#define OUTPUT 0x1
#define INPUT_PULLUP 0x2
#define INPUT_PULLDOWN 0x3
#define LED_BUILTIN 13
static const uint8_t A0 = 16;  // as on the Grasshopper: D14 and D15 are for I2C
static const uint8_t A1 = 17;
static const uint8_t A2 = 18;
static const uint8_t A3 = 19;
static const uint8_t A4 = 20;
static const uint8_t A5 = 21;
void pinMode(uint32_t pin, uint32_t mode);
void digitalWrite(uint32_t pin, uint32_t value);
int digitalRead(uint32_t pin);
int analogRead(uint32_t pin);
void analogReadResolution(int bits);  // 1..12; 10
void analogWrite(uint32_t pin, uint32_t value);
void tone(uint32_t pin, uint32_t frequency, uint32_t duration = 0);
void noTone(uint32_t pin);
// Returns the length of the next pulse in us, or 0 after `timeout` us without one.
uint32_t pulseIn(uint32_t pin, uint32_t state, uint32_t timeout = 1000000);

#define CHANGE 0x2
#define FALLING 0x3
#define RISING 0x4
#define digitalPinToInterrupt(pin) (pin)
void attachInterrupt(uint32_t pin, void (*callback)(), uint32_t mode);
void detachInterrupt(uint32_t pin);

#define PI 3.14159265358979323846
#define HALF_PI (PI / 2)
#define TWO_PI (PI * 2)
#define DEG_TO_RAD (PI / 180)
#define RAD_TO_DEG (180 / PI)

// Macros, as on the board: code that fails with them must also fail here. They come last, because they break the C++
// library's headers.
#undef abs
#define min(a, b) ((a) < (b) ? (a) : (b))
#define max(a, b) ((a) > (b) ? (a) : (b))
#define abs(x) ((x) > 0 ? (x) : -(x))
#define constrain(x, low, high) ((x) < (low) ? (low) : (x) > (high) ? (high) : (x))
#define round(x) ((x) >= 0 ? static_cast<long>((x) + 0.5) : static_cast<long>((x)-0.5))
#define radians(deg) ((deg)*DEG_TO_RAD)
#define degrees(rad) ((rad)*RAD_TO_DEG)
#define sq(x) ((x) * (x))
#define lowByte(w) (static_cast<uint8_t>((w)&0xFF))
#define highByte(w) (static_cast<uint8_t>((w) >> 8))
#define bit(b) (1UL << (b))
#define bitRead(value, b) (((value) >> (b)) & 1)
#define bitSet(value, b) ((value) |= bit(b))
#define bitClear(value, b) ((value) &= ~bit(b))
#define bitToggle(value, b) ((value) ^= bit(b))
#define bitWrite(value, b, x) ((x) ? bitSet(value, b) : bitClear(value, b))
