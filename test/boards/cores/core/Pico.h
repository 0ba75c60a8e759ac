// github.com/earlephilhower/arduino-pico 6.0.0 (387294c): cores/rp2040/SerialUART.h and .cpp, LocklessQueue.h.
// Bad characters are discarded (.cpp:532). begin() ends an open port (219). While it is open its settings stand (163), and
// another pin stops the board (61). end() keeps pins and settings (303).
#pragma once

#include "Api.h"

#define ARDUINO_ARCH_RP2040
#define EEPROM_EMULATED

class SerialUART : public Simulated<HardwareSerial> {
 public:
  SerialUART() : Simulated<HardwareSerial>({31, 1, 1, 32, sim::NoBaud, false, sim::Parity | sim::Framing}) {}
  bool setRX(uint8_t) { return !uart.isOpen(); }
  bool setTX(uint8_t) { return !uart.isOpen(); }
  bool setInvertRX(bool invert = true) { return set(_invertRx, invert); }
  bool setInvertTX(bool invert = true) { return set(_invertTx, invert); }
  bool setFIFOSize(size_t size) {
    if (!uart.isOpen()) {
      uart.setBuffer(size);
    }
    return !uart.isOpen();
  }
  void begin(unsigned long baud = 115200) override { begin(baud, SERIAL_8N1); }
  void begin(unsigned long baud, uint16_t config) override {
    uart.open(apiSettings(baud, config, _invertRx, _invertTx));
  }
  void end() override { uart.close(); }
  int availableForWrite() override { return uart.room() > 0 ? 1 : 0; }  // that is all it says
  operator bool() override { return uart.isOpen(); }

 private:
  bool set(bool &setting, bool value) {
    setting = uart.isOpen() ? setting : value;
    return !uart.isOpen();
  }
  bool _invertRx = false, _invertTx = false;
};
extern SerialUART Serial1, Serial2;

constexpr sim::Known Core = {true, true, 100000, 2, 0, false, true};
