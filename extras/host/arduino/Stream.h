#pragma once

#include "Print.h"

class Stream : public Print {
 public:
  virtual int available() = 0;
  virtual int read() = 0;
  virtual int peek() = 0;

  // How long readBytes() waits for the next byte, in ms.
  void setTimeout(unsigned long ms) { _timeout = ms; }
  unsigned long getTimeout() const { return _timeout; }

  // Reads until `size` bytes have come or the timeout has passed without one. Returns how many came.
  size_t readBytes(uint8_t *buffer, size_t size);
  size_t readBytes(char *buffer, size_t size) { return readBytes(reinterpret_cast<uint8_t *>(buffer), size); }

 private:
  unsigned long _timeout = 1000;
};
