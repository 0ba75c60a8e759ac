// github.com/PaulStoffregen/cores 7f107ee: teensy4/HardwareSerial.h and .cpp. Bad characters are kept
// (.cpp:638), begin() clears what waits (130), end() of a closed port does nothing (259). (Its uint32_t is an unsigned long.)
#pragma once

#include "../Stream.h"

#define CORE_TEENSY
#define SERIAL_8N1 0x00
#define SERIAL_8E1 0x06
#define SERIAL_8E2 0x106
#define SERIAL_8E1_RXINV_TXINV 0x36
#define SERIAL_8E2_RXINV_TXINV 0x136

class HardwareSerial : public Stream {
 public:
  virtual void begin(unsigned long baud, uint16_t format = 0) = 0;
  virtual void end() = 0;
  virtual int availableForWrite() = 0;
  using Print::write;
  virtual operator bool() = 0;
};
class HardwareSerialIMXRT : public Simulated<HardwareSerial> {
 public:
  // 64 places, of which one stays free. A closed port has no clock.
  HardwareSerialIMXRT() : Simulated<HardwareSerial>({63, 1, 1, 63, sim::Available | sim::Write, false, 0}) {}
  void begin(unsigned long baud, uint16_t format = 0) override {
    const unsigned stops = (format & 0x100) != 0 ? 2 : 1;
    uart.open({baud, (format & 0xF) == SERIAL_8E1 ? stops : 0, (format & 0x10) != 0, (format & 0x20) != 0});
  }
  void end() override { uart.close(); }
  int availableForWrite() override { return uart.room(); }
  operator bool() override { return true; }
};
extern HardwareSerialIMXRT Serial1, Serial2;

constexpr sim::Known Core = {true, true, 100000, 2, 0, true, true};
