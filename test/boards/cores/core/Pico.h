// github.com/earlephilhower/arduino-pico 6.0.0 (387294c): cores/rp2040/SerialUART.h and .cpp, LocklessQueue.h.
// Characters with errors are discarded (.cpp:532). begin() ends an open port (219). While it is open its settings stand
// (163), and another pin stops the board (61). end() keeps pins and settings (303), and resets the UART at once (319).
// A method that is interrupted holds a mutex: to the interrupt all of them return 0 (CoreMutex.cpp:47).
#pragma once

#include "Api.h"

#define ARDUINO_ARCH_RP2040
#define PICO_SDK_VERSION_MAJOR 2
#define EEPROM_EMULATED

class SerialUART : public Simulated<HardwareSerial> {
 public:
  SerialUART() : Simulated<HardwareSerial>({31, 1, 1, 32, sim::NoBaud, false, sim::Parity | sim::Framing}) {
    uart.keep(32);  // RP2040 datasheet, 4.2.2.4; micros() is a hardware timer's
  }
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
  void end() override { uart.cut(); }
  int available() override {
    return locked([&] { return uart.available(); });
  }
  int peek() override {
    return _isLocked ? -1 : locked([&] { return uart.peek(); });
  }
  int read() override {
    return _isLocked ? -1 : locked([&] { return uart.read(); });
  }
  int availableForWrite() override {  // that is all it says
    return locked([&] { return uart.room() > 0 ? 1 : 0; });
  }
  size_t write(const uint8_t *bytes, size_t size) override {
    return static_cast<size_t>(locked([&] { return static_cast<int>(Print::write(bytes, size)); }));
  }
  using Simulated<HardwareSerial>::write;
  operator bool() override { return uart.isOpen(); }

 private:
  template <typename Method>
  int locked(Method method) {
    if (_isLocked) {
      return 0;
    }
    _isLocked = true;
    sim::inPort();
    const int result = method();
    _isLocked = false;
    return result;
  }
  bool set(bool &setting, bool value) {
    setting = uart.isOpen() ? setting : value;
    return !uart.isOpen();
  }
  bool _invertRx = false, _invertTx = false;
  bool _isLocked = false;
};
extern SerialUART Serial1, Serial2;

constexpr sim::Known Core = {true, 2, 0, false};
