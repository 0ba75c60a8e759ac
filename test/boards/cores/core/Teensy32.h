// github.com/PaulStoffregen/cores 7f107ee: teensy3/HardwareSerial.h, serial1.c. Characters with errors are kept
// (serial1.c:635), begin() clears what waits (138). It has no 8E2. (Its uint32_t is an unsigned long.)
#pragma once

#include "../Stream.h"

#define CORE_TEENSY
#define SERIAL_8N1 0x00
#define SERIAL_8E1 0x06
#define SERIAL_8E1_RXINV_TXINV 0x36

class HardwareSerial : public Simulated<Stream> {
 public:
  // 64 places, of which one stays free; a FIFO that available() does not see.
  HardwareSerial() : Simulated<Stream>({63, 4, 1, 63, 0, false, 0}) {}
  virtual void begin(unsigned long baud) { begin(baud, SERIAL_8N1); }
  virtual void begin(unsigned long baud, uint32_t format) {
    uart.open({baud, (format & 0xF) == SERIAL_8E1 ? 1u : 0, (format & 0x10) != 0, (format & 0x20) != 0});
  }
  virtual void end() { uart.close(); }
  int availableForWrite() override { return uart.room(); }
  operator bool() { return true; }
};
extern HardwareSerial Serial1, Serial2;

constexpr sim::Known Core = {true, 1, 0, true};
