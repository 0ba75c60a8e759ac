#include "ReopenedPort.h"

#include <stdexcept>

namespace line {

bool ReopenedPort::next(uint64_t nowUs, Character &character) {
  if (!_port && nowUs >= _retryUs && comesBack(_device)) {
    _retryUs = nowUs + RetryUs;
    reopen();
  }
  if (!_port) {
    return false;
  }
  if (_port->next(nowUs, character)) {
    return true;
  }
  if (!_port->failure().empty()) {
    _port.reset();  // while it is open, the system would give the adapter another name
    _news = _device + (comesBack(_device) ? ": the port has gone; plug the adapter in again, it goes on by itself"
                                          : ": the program at its other end has gone");
  }
  return false;
}

void ReopenedPort::reopen() {
  try {
    _port = std::make_unique<SerialPort>(_device, _settings);
    _news = _device + ": the port is back";
  } catch (const std::runtime_error &) {
    // not yet: right after it has come back it may still belong to root
  }
}

}  // namespace line
