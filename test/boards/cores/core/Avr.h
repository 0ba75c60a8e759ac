// github.com/arduino/ArduinoCore-avr 1.8.8 (11b9130): cores/arduino/HardwareSerial.h, .cpp, HardwareSerial_private.h.
// A character with a parity error is discarded, one with a framing error is kept (_private.h:103). begin() keeps what
// waits
// (.cpp:117), end() clears it (163).
#pragma once

#include "../Stream.h"

#define ARDUINO_ARCH_AVR
#define SERIAL_RX_BUFFER_SIZE 64  // one place stays free
#define SERIAL_8N1 0x06
#define SERIAL_8E1 0x26
#define SERIAL_8E2 0x2E

class HardwareSerial : public Simulated<Stream> {
 public:
  HardwareSerial() : Simulated<Stream>({63, 1, 1, 63, 0, false, sim::Parity}) {}
  void begin(unsigned long baud) { begin(baud, SERIAL_8N1); }
  void begin(unsigned long baud, uint8_t config) {
    uart.change({baud, sim::evenStops<int>(config, SERIAL_8E1, SERIAL_8E2), false, false});
  }
  void end() { uart.close(); }
  int availableForWrite() override { return uart.room(); }
  operator bool() { return true; }
};
#if defined(ONE_PORT)  // an Uno
#define SBUS_PORT Serial
extern HardwareSerial Serial;
#else
#define HAVE_HWSERIAL1  // HardwareSerial.h:154
extern HardwareSerial Serial1, Serial2;
#endif

constexpr sim::Known Core = {false, 2, 0, true};
