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

  // Returns true if bytes that were written have not left yet. See PortFile.
  bool holdsBytes(uint64_t nowUs) {
    PortFile *const port = _port.at(nowUs);
    return port != nullptr && port->holdsBytes();
  }

  // Returns true if holdsBytes() may be wrong: see Unread.
  bool mayMissReads(uint64_t nowUs) {
    PortFile *const port = _port.at(nowUs);
    return port != nullptr && port->mayMissReads();
  }

  // Discards these bytes, if the port can.
  void discard(uint64_t nowUs) {
    PortFile *const port = _port.at(nowUs);
    if (port != nullptr) {
      port->discard();
    }
  }

  // See Line::news().
  std::string news() { return _port.news(); }

 private:
  Reopened<PortFile> _port;
};

}  // namespace line
