// github.com/arduino/ArduinoCore-mbed b4ad4e7: cores/arduino/Serial.h and .cpp, Arduino.h; of mbed-os, serial_api.c of
// RP2040 and NRF52. With NANO33 a Nano 33 BLE: 100000 baud becomes 76800, and two stop bits are an assertion that fails
// (ArduinoCore-mbed, issue 60). on_rx() keeps characters with errors (Serial.cpp:138), begin() what waits (106).
#pragma once

#include "Api.h"

#define ARDUINO_ARCH_MBED
#define NO_EEPROM
#if defined(NANO33)
#define ARDUINO_ARDUINO_NANO33BLE
#else
#define ARDUINO_ARCH_RP2040
#endif

namespace arduino {

class UART : public Simulated<HardwareSerial> {
 public:
  UART() : Simulated<HardwareSerial>({256, 1, 1, 0, sim::Write, false, 0}) {}
  void begin(unsigned long baud) override { begin(baud, SERIAL_8N1); }
  void begin(unsigned long baud, uint16_t config) override { begin(baud, config, false); }
  void begin(unsigned long baud, uint16_t config, bool) {
#if defined(NANO33)
    uart.change(apiSettings(baud < 115200 ? 76800 : 115200, config));
    if (config == SERIAL_8E2) {
      uart.crash();
      uart.close();
    }
#else
    uart.change(apiSettings(baud, config));
#endif
  }
  void end() override { uart.close(); }
  operator bool() override { return uart.isOpen(); }
};

}  // namespace arduino

extern arduino::UART _UART1_, _UART2_;
#define Serial1 _UART1_
#define Serial2 _UART2_

#if defined(NANO33)
constexpr sim::Known Core = {false, false, 76800, 2, 0, false, false};
#define OPENED_BY_HAND
inline void openByHand() {
  Serial1.begin(115200, SERIAL_8E1);
  Serial1.uart.change({100000, 1, false, false});  // as NRF_UARTE0->BAUDRATE = 0x0199A000 does
}
#else
constexpr sim::Known Core = {false, false, 100000, 2, 3000, false, true};
#endif
