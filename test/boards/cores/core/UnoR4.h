// github.com/arduino/ArduinoCore-renesas 1.5.3 (99f8ee4): cores/arduino/Serial.h and .cpp, Arduino.h. It cannot say how
// much it takes, and waits until the last character is under way (Serial.cpp:133), which end() cuts off. Characters
// with errors are discarded (71), begin() clears what waits (292). end() reads a null pointer if the port was never
// opened.
#pragma once

#include "Api.h"

#define ARDUINO_ARCH_RENESAS
#define ARDUINO_UNOR4_MINIMA
#define SERIAL_BUFFER_SIZE 512

class UART : public Simulated<HardwareSerial> {
 public:
  UART() : Simulated<HardwareSerial>({512, 1, 1, 1, sim::End, false, sim::Parity | sim::Framing}) {}
  void begin(unsigned long baud) override { begin(baud, SERIAL_8N1); }
  void begin(unsigned long baud, uint16_t config) override { uart.open(apiSettings(baud, config)); }
  void end() override { uart.cut(); }
  using Print::write;
  size_t write(uint8_t byte) override { return uart.write(byte); }
  size_t write(uint8_t *bytes, size_t size) { return Print::write(bytes, size); }  // not const
  operator bool() override { return true; }
};
extern UART _UART1_, _UART2_;
#define Serial1 _UART1_
#define Serial2 _UART2_

constexpr sim::Known Core = {false, 2, 3000, false};
