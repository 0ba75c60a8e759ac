// The baseline: the paper's listing (J. Lemaire, "Decoding the S-Bus protocol with a Grasshopper", §4.3.3), written
// from its description. It takes 25 bytes from a 0F on, and discards them all if the last is not 00. After 15 ms
// without a call it forgets an incomplete frame.
#pragma once

#include <stdint.h>

#include <Arduino.h>

#if defined(SERIAL_SBUS)
#include <stm32l0_uart.h>
#else
#define SERIAL_SBUS SERIAL_8E2
#endif

class PaperDecoder {
 public:
  explicit PaperDecoder(HardwareSerial &serial) : _serial(serial) {}

  void begin(unsigned long baud = 100000) {
    _serial.begin(baud, SERIAL_SBUS);
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
      if (_count == Size) {
        _count = 0;
        if (value == 0x00) {
          uint8_t *const frame = _coming;
          _coming = _complete;
          _complete = frame;
          _frames++;
        }
      }
    }
  }

  const uint8_t *frame() const { return _complete; }
  uint32_t frames() const { return _frames; }

 private:
  static constexpr uint8_t Size = 25;

  HardwareSerial &_serial;
  uint8_t _buffers[2][Size] = {};
  uint8_t *_coming = _buffers[0];
  uint8_t *_complete = _buffers[1];
  uint8_t _count = 0;
  uint32_t _frames = 0;
  uint32_t _lastCall = 0;
};
