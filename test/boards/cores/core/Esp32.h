// github.com/espressif/arduino-esp32: cores/esp32/HardwareSerial.h and .cpp of 3.x (8edd529); with ESP32_2 those of 2.0.3
// (00b486e). Before 2.0.6 it handed over 112 characters at once, since then 120.
#pragma once

#include "../Stream.h"

#define ESP32
#define ARDUINO_ARCH_ESP32
#define EEPROM_EMULATED
#if defined(ESP32_2)
#define SERIAL_8N1 0x800001c
#define SERIAL_8E1 0x800001e
#define SERIAL_8E2 0x800003e
using Done = void;
#else
enum SerialConfig { SERIAL_8N1 = 0x800001c, SERIAL_8E1 = 0x800001e, SERIAL_8E2 = 0x800003e };
using Done = bool;
#endif

class HardwareSerial : public Simulated<Stream> {
 public:
  HardwareSerial() : Simulated<Stream>({256, 120, 2, 128, sim::NoBaud, false}) {}
  void begin(unsigned long baud, uint32_t config = SERIAL_8N1, int8_t = -1, int8_t = -1, bool invert = false,
             unsigned long = 20000, uint8_t = 120) {
    if (invert != uart.settings().rxInverted && uart.isOpen()) {
      end();  // its driver begins anew
    }
    if (!uart.isOpen()) {
      uart.setBurst(120);
    }
    uart.change({baud, sim::evenStops<uint32_t>(config, SERIAL_8E1, SERIAL_8E2), invert, invert});
  }
#if defined(ESP32_2)
  void end(bool = true) { uart.close(); }
#else
  void end() { uart.close(); }
#endif
  Done setRxFIFOFull(uint8_t characters) {
    if (uart.isOpen()) {
      uart.setBurst(characters);
    }
    return Done(uart.isOpen());
  }
  unsigned setRxBufferSize(unsigned size) {  // not of an open port; their size_t has 32 bits
    if (uart.isOpen()) {
      return 0;
    }
    uart.setBuffer(size);
    return size;
  }
  Done setPins(int8_t, int8_t, int8_t = -1, int8_t = -1) { return Done(true); }
  using Simulated<Stream>::read;
  size_t read(uint8_t *buffer, size_t size) { return static_cast<size_t>(uart.read(buffer, size)); }
  int availableForWrite() override { return uart.room(); }
  operator bool() const { return uart.isOpen(); }
};
extern HardwareSerial Serial1, Serial2;

constexpr sim::Known Core = {true, true, 100000, 2, 0, true, true};

#define OPENED_BY_HAND
inline void openByHand() {
  Serial1.begin(100000, SERIAL_8E2, 16, 17, true);
}
