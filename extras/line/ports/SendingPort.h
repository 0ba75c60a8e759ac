// Sends over a serial port of this PC, whose adapter may be unplugged and plugged in again.
#pragma once

#include "line/ports/PortFile.h"
#include "line/ports/Reopened.h"

namespace line {

class SendingPort {
 public:
  // Throws std::runtime_error if it cannot be opened now.
  SendingPort(const std::string &device, const LineSettings &settings)
      : _port(device, [=] { return std::make_unique<PortFile>(device, settings, PortFile::Way::Write); }) {}

  // Never waits: bytes that the port cannot take, or that find it gone, are lost. Returns how many were written.
  size_t write(uint64_t nowUs, const uint8_t *bytes, size_t size);

  // Returns the news as Line::news() does.
  std::string news() { return _port.news(); }

 private:
  Reopened<PortFile> _port;
};

}  // namespace line
