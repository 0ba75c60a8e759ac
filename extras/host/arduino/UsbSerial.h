// UsbSerial: the USB connection to the PC. What a sketch prints becomes the program's standard output.
#pragma once

#include "HardwareSerial.h"

class UsbSerial : public HardwareSerial {
 public:
  void begin(unsigned long baud) override;  // before it, as on the board, what is printed is lost
  void begin(unsigned long baud, uint32_t config) override;
  int available() override { return 0; }  // nothing is ever sent to the sketch
  int peek() override { return -1; }
  int read() override { return -1; }
#if !defined(HOST_PLAIN_CORE)
  int read(uint8_t *, size_t) override { return 0; }
#endif
  void flush() override {}
  size_t write(uint8_t byte) override;
  size_t write(const uint8_t *buffer, size_t size) override;
  using Print::write;
  operator bool() override { return true; }
};

extern UsbSerial Serial;
