// The paper's way of receiving (J. Lemaire, "Decoding the S-Bus protocol with a Grasshopper", §4.3.3), the yardstick:
// 25 bytes from a 0F on; a frame if the last one is 00, else all 25 are given up; after 15 ms without a call what has
// come of a frame is forgotten. Written anew from its description.
#pragma once

#include <array>
#include <cstdint>

// Last: its macros min and max break the standard headers behind it.
#include <Arduino.h>
#include <stm32l0_uart.h>

class PaperReceiver {
 public:
  explicit PaperReceiver(HardwareSerial &serial) : _serial(serial) {}

  void begin() {
    _serial.begin(100000, SERIAL_SBUS);
    _lastCall = micros();
  }

  void parseSBusFrame() {
    const uint32_t now = micros();
    if (now - _lastCall > 15000) {
      _count = 0;
    }
    _lastCall = now;
    while (_serial.available() > 0) {
      const auto value = static_cast<uint8_t>(_serial.read());
      if (_count != 0 || value == 0x0F) {
        _coming[_count++] = value;
      }
      if (_count == _coming.size()) {
        _count = 0;
        if (value == 0x00) {
          _frame = _coming;
          _frames++;
        }
      }
    }
  }

  const std::array<uint8_t, 25> &frame() const { return _frame; }
  uint32_t frames() const { return _frames; }

 private:
  HardwareSerial &_serial;
  std::array<uint8_t, 25> _frame{};
  std::array<uint8_t, 25> _coming{};
  unsigned _count = 0;
  uint32_t _frames = 0;
  uint32_t _lastCall = 0;
};
