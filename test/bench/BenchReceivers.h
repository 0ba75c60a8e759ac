// Our receiver and the paper's, each at a port of its own.
#pragma once

#include "support/CleanArduino.h"

#include <DecodeSBus.h>

#include "support/PaperDecoder.h"

// The smallest possible serial port, in memory. Its methods take the same for the same number of bytes, which can thus
// be subtracted.
class MemorySerial : public HardwareSerial {
 public:
  struct Calls {
    uint32_t available;
    uint32_t singleReads;
    uint32_t reads;  // read(buffer, size)
    uint32_t bytes;  // by these
  };
  Calls calls = Calls();

  // Sets the bytes that wait, which are not copied. The calls are counted from then on.
  void put(const uint8_t *bytes, size_t count) {
    _next = bytes;
    _end = bytes + count;
    _landing = 0;
    calls = Calls();
  }

  // The driver hands over so many zeros more, up to 16, while the bytes are read.
  void land(size_t count) { _landing = count; }

  int available() override;
  int peek() override { return -1; }
  int read() override;
  int read(uint8_t *buffer, size_t size) override;
  void flush() override {}
  size_t write(uint8_t) override { return 0; }
  operator bool() override { return true; }

 private:
  const uint8_t *_next = nullptr;
  const uint8_t *_end = nullptr;
  size_t _landing = 0;
};

struct Ours {
  MemorySerial port;
  DecodeSBus receiver{port};

  void parse();
  uint32_t frames() const { return receiver.counters().frames; }
};

struct Papers {
  MemorySerial port;
  PaperDecoder receiver{port};

  void parse();
  uint32_t frames() const { return receiver.frames(); }
};
