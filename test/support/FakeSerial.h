// A serial port whose receive buffer the test fills, and which notes how it was opened. As on the board, bytes that
// find the buffer full, or the port closed, are lost: of a burst that does not fit, the newest.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <vector>

#include "CleanArduino.h"

class FakeSerial : public HardwareSerial {
 public:
  struct Opening {
    unsigned long baud;
    uint32_t config;
  };

  // 64 on the board; 63 on an AVR, whose ring keeps one of its 64 places free.
  explicit FakeSerial(size_t capacity = 64) : _capacity(capacity) {}

  std::vector<uint8_t> written;
  int placesToWrite = 64;  // what the transmit buffer takes, however much is written

  std::vector<Opening> openings;
  unsigned closings = 0;
  unsigned singleReads = 0;
  unsigned asked = 0;      // available()
  unsigned overasked = 0;  // read() of more than was available

  std::function<void()> beforeRead = [] {};  // what comes in while a sketch reads

  // What comes in between the two times that the board's core reads its count, if it is asked for more than is there.
  // The core then writes up to 12 bytes more than it was asked for, past the end of the buffer.
  std::vector<uint8_t> landing;

  // Takes `bytes` from the wire. Returns how many were kept.
  template <typename Container>
  size_t arrive(const Container &bytes) {
    const size_t before = _waiting.size();
    for (const uint8_t newest : bytes) {
      if (_isOpen && _waiting.size() < _capacity) {
        _waiting.push_back(newest);
      }
    }
    return _waiting.size() - before;
  }

  void begin(unsigned long baud) override { begin(baud, 0); }
  void begin(unsigned long baud, uint32_t config) override {
    openings.push_back({baud, config});
    _isOpen = true;
    _waiting.clear();  // stm32l0_uart.c:846
  }
  void end() override {
    closings++;
    _isOpen = false;
    _waiting.clear();
  }
  int available() override {
    asked++;
    return static_cast<int>(_waiting.size());
  }
  int peek() override { return _waiting.empty() ? -1 : _waiting.front(); }
  int read() override {
    singleReads++;
    return next();
  }
  void onReceive(void (*)()) {}  // the board's Uart has it
  int read(uint8_t *buffer, size_t size) override {
    beforeRead();
    size_t most = size;
    if (size > _waiting.size()) {
      overasked++;
      most += arrive(landing) != 0 ? 12 : 0;
    }
    size_t count = 0;
    while (count < most && !_waiting.empty()) {
      buffer[count++] = static_cast<uint8_t>(next());
    }
    return static_cast<int>(count);
  }
  void flush() override {}
  int availableForWrite() override { return _isOpen ? placesToWrite : 0; }
  size_t write(uint8_t value) override {
    written.push_back(value);
    return 1;
  }
  using Print::write;
  operator bool() override { return _isOpen; }

 private:
  int next() {
    if (_waiting.empty()) {
      return -1;
    }
    const int oldest = _waiting.front();
    _waiting.pop_front();
    return oldest;
  }

  const size_t _capacity;
  bool _isOpen = false;
  std::deque<uint8_t> _waiting;
};
