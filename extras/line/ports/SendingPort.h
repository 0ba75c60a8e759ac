// Sends over a serial port of this PC, whose adapter may be unplugged and plugged in again.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "PortFile.h"

namespace line {

class SendingPort {
 public:
  // Throws std::runtime_error if it cannot be opened now.
  SendingPort(const std::string &device, const LineSettings &settings)
      : _device(device),
        _settings(settings),
        _port(std::make_unique<PortFile>(device, settings, PortFile::Way::Write)) {}

  // Never waits: what the port cannot take, or finds it gone, is lost. Returns how many bytes were not.
  size_t write(uint64_t nowUs, const uint8_t *bytes, size_t size);

  // As Line's.
  std::string news() { return std::exchange(_news, {}); }

 private:
  static constexpr uint64_t RetryUs = 500000;

  void reopen();

  std::string _device;
  LineSettings _settings;
  std::unique_ptr<PortFile> _port;  // none while it is gone
  uint64_t _retryUs = 0;
  std::string _news;
};

}  // namespace line
