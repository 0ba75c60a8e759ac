// UsbSerial: the USB connection to the PC. The sketch prints to the program's standard output and reads its standard
// input.
#pragma once

#include "HardwareSerial.h"

class UsbSerial : public HardwareSerial {
 public:
  // Before begin(), as on the board, output is lost, and there is no input.
  void begin(unsigned long baud) override;
  void begin(unsigned long baud, uint32_t config) override;
  int available() override;
  int peek() override;
  int read() override;
  int read(uint8_t *buffer, size_t size) override;
  int availableForWrite() override { return 256; }  // the board's buffer; here it is always read
  void flush() override {}
  size_t write(uint8_t byte) override;
  size_t write(const uint8_t *buffer, size_t size) override;
  using HardwareSerial::write;
  operator bool() override { return true; }
};

extern UsbSerial Serial;
