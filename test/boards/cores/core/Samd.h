// github.com/arduino/ArduinoCore-samd 1.8.14 (993398c): cores/arduino/Uart.h and .cpp, SERCOM.cpp, main.cpp.
// A framing error is discarded (Uart.cpp:93), a parity error kept (101). begin() keeps what waits (48).
#pragma once

#include "Api.h"

#define ARDUINO_ARCH_SAMD
#define NO_EEPROM
#define SERIAL_BUFFER_SIZE 256

class Uart : public Simulated<HardwareSerial> {
 public:
  Uart() : Simulated<HardwareSerial>({256, 1, 1, 256, sim::End, false, sim::Framing}) {}
  void begin(unsigned long baud) override { begin(baud, SERIAL_8N1); }
  void begin(unsigned long baud, uint16_t config) override { uart.change(apiSettings(baud, config)); }
  void end() override { uart.close(); }
  int availableForWrite() override { return uart.room(); }
  operator bool() override { return true; }
};
extern Uart Serial1, Serial2;

constexpr sim::Known Core = {false, false, 100000, 2, 0, true, true};
