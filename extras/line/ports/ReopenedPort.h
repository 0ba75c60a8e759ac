// A serial port whose adapter may be unplugged and plugged in again. A pseudo-terminal that has gone is not waited for:
// the next of its name may be anybody's.
#pragma once

#include <memory>
#include <utility>

#include "SerialPort.h"

namespace line {

class ReopenedPort : public Line {
 public:
  // Throws std::runtime_error if it cannot be opened now.
  ReopenedPort(const std::string &device, const LineSettings &settings)
      : _device(device), _settings(settings), _port(std::make_unique<SerialPort>(device, settings)) {}

  bool next(uint64_t nowUs, Character &character) override;
  bool finished(uint64_t) const override { return !_port && !comesBack(_device); }
  std::string news() override { return std::exchange(_news, {}); }

 private:
  static constexpr uint64_t RetryUs = 500000;

  void reopen();

  std::string _device;
  LineSettings _settings;
  std::unique_ptr<SerialPort> _port;  // none while it is gone
  uint64_t _retryUs = 0;              // when it is tried next
  std::string _news;
};

}  // namespace line
