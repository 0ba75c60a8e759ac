#include "SendingPort.h"

#include <unistd.h>

#include <cerrno>
#include <stdexcept>

namespace line {

size_t SendingPort::write(uint64_t nowUs, const uint8_t *bytes, size_t size) {
  if (!_port && nowUs >= _retryUs && comesBack(_device)) {
    _retryUs = nowUs + RetryUs;
    reopen();
  }
  if (!_port) {
    return 0;
  }
  const ssize_t count = ::write(_port->file(), bytes, size);
  if (count < 0 && errno != EAGAIN && errno != EINTR) {
    _port.reset();  // while it is open, the system would give the adapter another name
    _news = _device + (comesBack(_device) ? ": the port has gone; plug the adapter in again, it goes on by itself"
                                          : ": the program at its other end has gone");
  }
  return count > 0 ? static_cast<size_t>(count) : 0;
}

void SendingPort::reopen() {
  try {
    _port = std::make_unique<PortFile>(_device, _settings, PortFile::Way::Write);
    _news = _device + ": the port is back";
  } catch (const std::runtime_error &) {
    // not yet
  }
}

}  // namespace line
