// Sends over a serial port of this PC. The adapter may be unplugged and plugged in again.
#pragma once

#include "line/ports/PortFile.h"
#include "line/ports/Reopened.h"

namespace line {

class SendingPort {
 public:
  // Opens the port. Throws std::runtime_error.
  SendingPort(const std::string &device, const LineSettings &settings)
      : _port(device, [=] { return std::make_unique<PortFile>(device, settings, PortFile::Way::Write); }) {}

  // Writes without waiting; bytes are lost if the port is full or gone. Returns the number written.
  size_t write(uint64_t nowUs, const uint8_t *bytes, size_t size);

  // Returns the port; null while it is gone.
  PortFile *at(uint64_t nowUs) { return _port.at(nowUs); }

  // Returns true if it is gone and will not come back.
  bool finished() const { return _port.finished(); }

  // See Line::news().
  std::string news() { return _port.news(); }

 private:
  Reopened<PortFile> _port;
};

}  // namespace line
