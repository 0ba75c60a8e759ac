// Uart: the board's serial ports. What a port receives is decided by the program around the sketch (runtime/Port.h).
#pragma once

#include "HardwareSerial.h"

namespace host {
class Port;
}

class Uart : public HardwareSerial {
 public:
  explicit Uart(int number) : _number(number) {}

  void begin(unsigned long baud) override;
  void begin(unsigned long baud, uint32_t config) override;
  void begin(unsigned long baud, uint8_t *buffer, size_t size);
  // With a receive buffer of the sketch's own instead of the 64 bytes; at least 16 bytes, or the port stays closed.
  void begin(unsigned long baud, uint32_t config, uint8_t *buffer, size_t size);
  void end() override;
  int available() override;
  int peek() override;
  int read() override;
#if !defined(HOST_PLAIN_CORE)
  int read(uint8_t *buffer, size_t size) override;
#endif
  void flush() override {}
  size_t write(uint8_t byte) override;  // nothing is connected to TX: an open port takes the byte, and that is all
  using Print::write;
  operator bool() override { return true; }

  // `callback` runs when received bytes have been handed over: once, then again after the next read. On the board that
  // is at PendSV level, in the middle of anything; here whenever the sketch asks for the time or looks at a port.
  void onReceive(void (*callback)());

 private:
  host::Port &port() const;

  const int _number;
};

extern Uart Serial1;
extern Uart Serial2;
extern Uart Serial3;
