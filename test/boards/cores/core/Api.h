// github.com/arduino/ArduinoCore-API cd91833: api/HardwareSerial.h, Print.h, Stream.h. Of arduino-pico, megaAVR, Uno
// R4, SAMD.
#pragma once

#define ARDUINO_API
#include "../Stream.h"

#define SERIAL_8N1 0x413ul
#define SERIAL_8E1 0x411ul
#define SERIAL_8E2 0x431ul

namespace arduino {

class HardwareSerial : public Stream {
 public:
  virtual void begin(unsigned long) = 0;
  virtual void begin(unsigned long baud, uint16_t config) = 0;
  virtual void end() = 0;
  virtual int available() = 0;
  virtual int peek() = 0;
  virtual int read() = 0;
  virtual void flush() = 0;
  virtual size_t write(uint8_t) = 0;
  using Print::write;
  virtual operator bool() = 0;
};

}  // namespace arduino

inline sim::Settings apiSettings(unsigned long baud, uint16_t config, bool rxInverted = false,
                                 bool txInverted = false) {
  return {baud, sim::evenStops<unsigned long>(config, SERIAL_8E1, SERIAL_8E2), rxInverted, txInverted};
}
