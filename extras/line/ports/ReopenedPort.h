// A serial port whose adapter may be unplugged and plugged in again.
#pragma once

#include "Reopened.h"
#include "SerialPort.h"

namespace line {

class ReopenedPort : public Line {
 public:
  // Throws std::runtime_error if it cannot be opened now.
  ReopenedPort(const std::string &device, const LineSettings &settings)
      : _port(device, [=] { return std::make_unique<SerialPort>(device, settings); }) {}

  bool next(uint64_t nowUs, Character &character) override;
  bool finished(uint64_t) const override { return _port.finished(); }
  std::string news() override { return _port.news(); }

 private:
  Reopened<SerialPort> _port;
};

}  // namespace line
