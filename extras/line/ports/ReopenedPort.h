// A serial port with an adapter that may be unplugged and plugged in again.
#pragma once

#include "line/ports/Reopened.h"
#include "line/ports/SerialPort.h"

namespace line {

class ReopenedPort : public Line {
 public:
  // Opens the port. Throws std::runtime_error.
  ReopenedPort(const std::string &device, const LineSettings &settings)
      : _port(device, [=] { return std::make_unique<SerialPort>(device, settings); }) {}

  bool next(uint64_t nowUs, Character &character) override;
  uint64_t knownUs(uint64_t nowUs) const override { return _open == nullptr ? 0 : _open->knownUs(nowUs); }
  bool wait() override;
  bool finished(uint64_t) const override { return _port.finished(); }
  bool isBroken() const override { return true; }
  std::string note() const override { return _open == nullptr ? "" : _open->note(); }
  std::string news() override { return _port.news(); }

 private:
  Reopened<SerialPort> _port;
  SerialPort *_open = nullptr;  // null while it is gone
};

}  // namespace line
