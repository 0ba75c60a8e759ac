// A port that receives as the board does, and the cable to it from a port that sends. To be included last: Arduino.h's
// macros min and max break the standard headers after them.
#pragma once

#include "FakeClock.h"
#include "board/BoardUart.h"
#include "line/LineSettings.h"

#include "FakeSerial.h"

class BoardPort : public FakeSerial {
 public:
  host::BoardUart uart;

  // Bytes that the driver has handed over since the port's first opening, whether they were read or not.
  uint64_t handedOver() const { return _read + static_cast<uint64_t>(uart.available()); }

  void begin(unsigned long baud) override { begin(baud, 0); }
  void begin(unsigned long baud, uint32_t config) override {
    FakeSerial::begin(baud, config);
    uart.open(fakeMicros, line::LineSettings{baud}.characterUs());
  }
  void end() override {
    FakeSerial::end();
    uart.close();
  }
  int available() override { return uart.available(); }
  int peek() override { return uart.peek(); }
  int read() override {
    uint8_t value;
    return read(&value, 1) == 1 ? value : -1;
  }
  int read(uint8_t *buffer, size_t size) override {
    const int count = uart.read(buffer, size);
    _read += static_cast<uint64_t>(count);
    return count;
  }

 private:
  uint64_t _read = 0;
};

// What one port writes goes out back to back, as fast as that port was opened. A port that was opened at another baud
// rate hears nothing.
class Cable {
 public:
  Cable(const FakeSerial &from, BoardPort &to) : _from(from), _to(to) {}

  // Up to now. To be called after each write, and before each poll.
  void carry() {
    const unsigned long baud = _from.openings.back().baud;
    for (; _sent < _from.written.size(); _sent++) {
      _busyUntilUs = (_busyUntilUs > fakeMicros ? _busyUntilUs : fakeMicros) + line::LineSettings{baud}.characterUs();
      line::Character character;
      character.endUs = _busyUntilUs;
      character.value = _from.written[_sent];
      _onTheWay.push_back(character);
    }
    for (; !_onTheWay.empty() && _onTheWay.front().endUs <= fakeMicros; _onTheWay.pop_front()) {
      if (_to.openings.back().baud == baud) {
        _to.uart.receive(_onTheWay.front());
      }
    }
    _to.uart.advance(fakeMicros);
  }

 private:
  const FakeSerial &_from;
  BoardPort &_to;
  size_t _sent = 0;
  uint64_t _busyUntilUs = 0;
  std::deque<line::Character> _onTheWay;
};
