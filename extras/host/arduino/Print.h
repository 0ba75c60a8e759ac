// Print: numbers and text as bytes, digit for digit as the board prints them.
#pragma once

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#define BIN 2
#define OCT 8
#define DEC 10
#define HEX 16

// F("text") only marks its text, so that print() takes it through an overload of its own, as on the board.
class __FlashStringHelper;
#define F(text) (reinterpret_cast<const __FlashStringHelper *>(text))

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
  size_t print(const char *text) { return write(text); }
  size_t print(char c) { return write(static_cast<uint8_t>(c)); }
  size_t print(unsigned char number, int base = DEC) { return printUnsigned(number, base); }
  size_t print(int number, int base = DEC) { return printSigned(number, base); }
  size_t print(unsigned number, int base = DEC) { return printUnsigned(number, base); }
  // A long has 32 bits on the board: whatever lies above is cut off.
  size_t print(long number, int base = DEC) { return printSigned(static_cast<int32_t>(number), base); }
  size_t print(unsigned long number, int base = DEC) { return printUnsigned(static_cast<uint32_t>(number), base); }
  size_t print(double number, int digits = 2);

  size_t println() { return write("\r\n"); }
  template <typename T>
  size_t println(T value) {
    const size_t printed = print(value);
    return printed + println();
  }
  template <typename T>
  size_t println(T value, int baseOrDigits) {
    const size_t printed = print(value, baseOrDigits);
    return printed + println();
  }

 private:
  size_t printSigned(int32_t number, int base);
  size_t printUnsigned(uint32_t number, int base);
};
