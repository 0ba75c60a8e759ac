#include "ReopenedPort.h"

namespace line {

bool ReopenedPort::next(uint64_t nowUs, Character &character) {
  SerialPort *const port = _port.at(nowUs);
  if (port == nullptr) {
    return false;
  }
  if (port->next(nowUs, character)) {
    return true;
  }
  if (!port->failure().empty()) {
    _port.gone();
  }
  return false;
}

}  // namespace line
