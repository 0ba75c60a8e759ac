// github.com/PaulStoffregen/cores 7f107ee: teensy4/HardwareSerial.h and .cpp; with TEENSY32 teensy3/HardwareSerial.h,
// serial1.c. (Their uint32_t is an unsigned long.)
#pragma once

#include "../Stream.h"

#define CORE_TEENSY
#define SERIAL_8N1 0x00
#define SERIAL_8E1 0x06
#define SERIAL_8E1_RXINV_TXINV 0x36

#if defined(TEENSY32)  // no 8E2; a FIFO that available() does not see
using Format = uint32_t;
class HardwareSerial : public Simulated<Stream> {
 public:
  HardwareSerial() : Simulated<Stream>({63, 4, 1, 63, 0, false}) {}
  virtual void begin(unsigned long baud) { begin(baud, SERIAL_8N1); }
  virtual void begin(unsigned long baud, Format format) { open(baud, format); }
  virtual void end() { uart.close(); }
#else
#define SERIAL_8E2 0x106
#define SERIAL_8E2_RXINV_TXINV 0x136
using Format = uint16_t;
class HardwareSerial : public Stream {
 public:
  virtual void begin(unsigned long baud, Format format = 0) = 0;
  virtual void end() = 0;
  virtual int availableForWrite() = 0;
  using Print::write;
  virtual operator bool() = 0;
};
class HardwareSerialIMXRT : public Simulated<HardwareSerial> {
 public:
  HardwareSerialIMXRT() : Simulated<HardwareSerial>({63, 1, 1, 63, sim::Available | sim::Write, false}) {}
  void begin(unsigned long baud, Format format = 0) override { open(baud, format); }
  void end() override { uart.close(); }
#endif
  int availableForWrite() override { return uart.room(); }
  operator bool() { return true; }

 private:
  void open(unsigned long baud, Format format) {
    const unsigned stops = (format & 0x100) != 0 ? 2 : 1;
    uart.open({baud, (format & 0xF) == SERIAL_8E1 ? stops : 0, (format & 0x10) != 0, (format & 0x20) != 0});
  }
};
#if defined(TEENSY32)
extern HardwareSerial Serial1, Serial2;
#else
extern HardwareSerialIMXRT Serial1, Serial2;
#endif

#if defined(TEENSY32)
constexpr sim::Known Core = {true, true, 100000, 1, 0, true, true};
#else
constexpr sim::Known Core = {true, true, 100000, 2, 0, true, true};
#endif
