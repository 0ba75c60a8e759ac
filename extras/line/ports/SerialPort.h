// A real receiver, at a serial port of this PC: an adapter whose RXD is inverted, or with an inverter in front of it.
#pragma once

#include <deque>
#include <string>

#include "PortFile.h"
#include "line/Line.h"

namespace line {

class SerialPort : public Line {
 public:
  // Throws std::runtime_error, with a line that says what is wrong and what to do.
  explicit SerialPort(const std::string &device, const LineSettings &settings = {});

  bool next(uint64_t nowUs, Character &character) override;
  std::string failure() const override { return _failure; }

 private:
  // An adapter marks a bad character as FF 00 character, and sends FF as FF FF.
  enum class Mark { None, Escape, Bad };

  static constexpr uint64_t LaterUs = 2000;

  void poll(uint64_t nowUs);
  void take(uint8_t byte, uint64_t nowUs);

  std::string _device;
  PortFile _port;
  uint32_t _characterUs;
  std::string _failure;

  Mark _mark = Mark::None;
  std::deque<Character> _waiting;
  uint64_t _lastEndUs = 0;
  uint64_t _nextPollUs = 0;
};

}  // namespace line
