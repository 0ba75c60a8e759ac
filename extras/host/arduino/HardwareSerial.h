// HardwareSerial: a serial port as seen by a library. It is abstract, as on the board, so a test can supply its own.
#pragma once

#include "SerialConfig.h"
#include "Stream.h"

class HardwareSerial : public Stream {
 public:
  virtual void begin(unsigned long /*baud*/) {}
  virtual void begin(unsigned long /*baud*/, uint32_t /*config*/) {}
  virtual void end() {}
  virtual int available() = 0;
  virtual int peek() = 0;
  virtual int read() = 0;
  virtual int read(uint8_t *buffer, size_t size) = 0;
  virtual void flush() = 0;
  virtual size_t write(uint8_t byte) = 0;
  using Print::write;
  // Without these write(0) could also mean a null pointer (arduino/ArduinoCore-avr,
  // cores/arduino/HardwareSerial.h:130).
  size_t write(int byte) { return write(static_cast<uint8_t>(byte)); }
  size_t write(unsigned byte) { return write(static_cast<uint8_t>(byte)); }
  size_t write(long byte) { return write(static_cast<uint8_t>(byte)); }
  size_t write(unsigned long byte) { return write(static_cast<uint8_t>(byte)); }
  virtual operator bool() = 0;
};
