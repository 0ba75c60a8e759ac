// Print and Stream, as all cores have them, in the core's namespace; and the part of a port that all cores share.
#pragma once

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "Uart.h"

#define DEC 10
#define HEX 16
#define F(text) (text)

#if defined(ARDUINO_API)
namespace arduino {
#endif

class Print {
 public:
  virtual size_t write(uint8_t byte) = 0;
  virtual size_t write(const uint8_t *bytes, size_t size) {
    size_t count = 0;
    while (count < size && write(bytes[count]) != 0) {
      count++;
    }
    return count;
  }
#if !defined(PRINT_WITHOUT_ROOM)
  virtual int availableForWrite() { return 0; }
#endif
  virtual void flush() {}

  size_t print(const char *text) { return write(reinterpret_cast<const uint8_t *>(text), strlen(text)); }
  size_t print(char c) { return write(static_cast<uint8_t>(c)); }
  size_t print(long number, int base = DEC) {
    return number < 0 ? print('-') + digits(0ul - static_cast<unsigned long>(number), base)
                      : digits(static_cast<unsigned long>(number), base);
  }
  size_t print(unsigned long number, int base = DEC) { return digits(number, base); }
  size_t print(int number, int base = DEC) { return print(static_cast<long>(number), base); }
  size_t print(unsigned number, int base = DEC) { return digits(number, base); }
  size_t print(double number, int = 2) { return print(static_cast<long>(number)); }
  size_t println() { return print("\r\n"); }
  template <typename T>
  size_t println(T value) {
    return print(value) + println();
  }
  template <typename T>
  size_t println(T value, int base) {
    return print(value, base) + println();
  }

 private:
  size_t digits(unsigned long number, int base) {
    const unsigned long radix = static_cast<unsigned long>(base);
    const size_t before = number < radix ? 0 : digits(number / radix, base);
    return before + print("0123456789ABCDEF"[number % radix]);
  }
};

class Stream : public Print {
 public:
  virtual int available() = 0;
  virtual int read() = 0;
  virtual int peek() = 0;
};

// The part that the cores' classes share: a Uart. Base is the class that they derive from.
template <class Base>
class Simulated : public Base {
 public:
  explicit Simulated(const sim::Facts &facts, sim::Drops drops = sim::Newest, bool wired = true)
      : uart(facts, drops, wired) {}
  using Base::read;
  int available() override { return uart.available(); }
  int peek() override { return uart.peek(); }
  int read() override { return uart.read(); }
  void flush() override { uart.flush(); }
  using Print::write;
  size_t write(uint8_t byte) override { return uart.write(byte); }

  sim::Uart uart;
};

#if defined(ARDUINO_API)
}  // namespace arduino
using namespace arduino;
#endif

// Serial: USB.
class Console : public Stream {
 public:
  void begin(unsigned long) {}
  int available() override { return 0; }
  int peek() override { return -1; }
  int read() override { return -1; }
  using Print::write;
  size_t write(uint8_t byte) override {
    sim::print(static_cast<char>(byte));
    return 1;
  }
#if !defined(PRINT_WITHOUT_ROOM)
  int availableForWrite() override { return 64; }
#else
  int availableForWrite() { return 64; }
#endif
  operator bool() { return true; }
};
