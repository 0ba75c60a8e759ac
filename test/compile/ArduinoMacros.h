// The macros of the board's Arduino.h that can break a C++ source. The core is compiled with this file included first.
#pragma once

#include <stdint.h>
#include <stdlib.h>

typedef bool boolean;
typedef uint8_t byte;
typedef uint16_t word;

#undef abs
#define min(a, b) ((a) < (b) ? (a) : (b))
#define max(a, b) ((a) > (b) ? (a) : (b))
#define abs(x) ((x) > 0 ? (x) : -(x))
#define round(x) ((x) >= 0 ? (long)((x) + 0.5) : (long)((x)-0.5))
#define constrain(x, low, high) ((x) < (low) ? (low) : (x) > (high) ? (high) : (x))
#define sq(x) ((x) * (x))
#define radians(deg) ((deg)*0.017453292519943295)
#define degrees(rad) ((rad)*57.29577951308232)
#define interrupts() __enable_irq()
#define noInterrupts() __disable_irq()
#define lowByte(w) ((uint8_t)((w)&0xff))
#define highByte(w) ((uint8_t)((w) >> 8))
#define bit(b) (1UL << (b))
#define bitRead(value, b) (((value) >> (b)) & 0x01)
#define bitSet(value, b) ((value) |= (1UL << (b)))
#define bitClear(value, b) ((value) &= ~(1UL << (b)))
#define bitWrite(value, b, x) (x ? bitSet(value, b) : bitClear(value, b))
#define F(text) (reinterpret_cast<const char *>(text))
#define B00001111 15
#define B11110000 240
#define LOW 0x0
#define HIGH 0x1
#define INPUT 0x0
#define OUTPUT 0x1
#define CHANGE 2
#define FALLING 3
#define RISING 4
#define DEFAULT 1
#define PI 3.1415926535897932
#define BIN 2
#define OCT 8
#define DEC 10
#define HEX 16
