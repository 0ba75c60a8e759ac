// Sends over a serial port of this PC, whose adapter may be unplugged and plugged in again.
#pragma once

#include "line/ports/PortFile.h"
#include "line/ports/Reopened.h"

namespace line {

class SendingPort {
 public:
  // Opens the port. Throws std::runtime_error if that is not possible now.
  SendingPort(const std::string &device, const LineSettings &settings)
      : _port(device, [=] { return std::make_unique<PortFile>(device, settings, PortFile::Way::Write); }) {}

  // Writes without waiting: bytes are lost if the port cannot take them, or is gone. Returns how many were written.
  size_t write(uint64_t nowUs, const uint8_t *bytes, size_t size);

  // Returns the news as Line::news() does.
  std::string news() { return _port.news(); }

 private:
  Reopened<PortFile> _port;
};

}  // namespace line
