#include "line/ports/SendingPort.h"

namespace line {

size_t SendingPort::write(uint64_t nowUs, const uint8_t *bytes, size_t size) {
  PortFile *const port = _port.at(nowUs);
  if (port == nullptr) {
    return 0;
  }
  const std::ptrdiff_t count = port->write(bytes, size);
  if (count < 0) {
    _port.gone();
  }
  return count > 0 ? static_cast<size_t>(count) : 0;
}

}  // namespace line
