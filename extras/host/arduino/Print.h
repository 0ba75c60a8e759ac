// Print: numbers and text as bytes, digit for digit as the board prints them.
#pragma once

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>  // as on the board (GrumpyOldPizza/ArduinoCore-stm32l0, cores/arduino/Print.h:23): sprintf()
#include <string.h>

#include "WString.h"

#define BIN 2
#define OCT 8
#define DEC 10
#define HEX 16

class Print;

// A base class for the sketch's own printable classes.
class Printable {
 public:
  virtual size_t printTo(Print &print) const = 0;

 protected:
  ~Printable() = default;
};

class Print {
 public:
  virtual ~Print() = default;

  virtual size_t write(uint8_t byte) = 0;
  virtual size_t write(const uint8_t *buffer, size_t size);
  size_t write(const char *buffer, size_t size) { return write(reinterpret_cast<const uint8_t *>(buffer), size); }
  size_t write(const char *text) { return text == nullptr ? 0 : write(text, strlen(text)); }
  virtual int availableForWrite() { return 0; }
  virtual void flush() {}

  size_t print(const __FlashStringHelper *text) { return write(reinterpret_cast<const char *>(text)); }
  size_t print(const String &text) { return write(text.c_str(), text.length()); }
  size_t print(const char *text) { return write(text); }
  size_t print(char c) { return write(static_cast<uint8_t>(c)); }
  size_t print(unsigned char number, int base = DEC) { return printUnsigned(number, base); }
  size_t print(int number, int base = DEC) { return printSigned(number, base); }
  size_t print(unsigned number, int base = DEC) { return printUnsigned(number, base); }
  // A long has 32 bits on the board: higher bits are cut off.
  size_t print(long number, int base = DEC) { return printSigned(static_cast<int32_t>(number), base); }
  size_t print(unsigned long number, int base = DEC) { return printUnsigned(static_cast<uint32_t>(number), base); }
  size_t print(double number, int digits = 2);
  size_t print(const Printable &value) { return value.printTo(*this); }

  size_t println() { return write("\r\n"); }
  size_t println(const __FlashStringHelper *text) { return endLine(print(text)); }
  size_t println(const String &text) { return endLine(print(text)); }
  size_t println(const char *text) { return endLine(print(text)); }
  size_t println(char c) { return endLine(print(c)); }
  size_t println(unsigned char number, int base = DEC) { return endLine(print(number, base)); }
  size_t println(int number, int base = DEC) { return endLine(print(number, base)); }
  size_t println(unsigned number, int base = DEC) { return endLine(print(number, base)); }
  size_t println(long number, int base = DEC) { return endLine(print(number, base)); }
  size_t println(unsigned long number, int base = DEC) { return endLine(print(number, base)); }
  size_t println(double number, int digits = 2) { return endLine(print(number, digits)); }
  size_t println(const Printable &value) { return endLine(print(value)); }

  // ESP32, Pico and Teensy have it (espressif/arduino-esp32, cores/esp32/Print.h:69), the Grasshopper and AVR do not.
  size_t printf(const char *format, ...) __attribute__((format(printf, 2, 3)));

 private:
  size_t printSigned(int32_t number, int base);
  size_t printUnsigned(uint32_t number, int base);
  size_t endLine(size_t printed) { return printed + println(); }
};
