#include "line/ports/ReopenedPort.h"

#include <chrono>
#include <thread>

namespace line {

bool ReopenedPort::next(uint64_t nowUs, Character &character) {
  _open = _port.at(nowUs);
  if (_open == nullptr) {
    return false;
  }
  if (_open->next(nowUs, character)) {
    return true;
  }
  if (!_open->failure().empty()) {
    _port.gone();
    _open = nullptr;
  }
  return false;
}

bool ReopenedPort::wait() {
  if (_open != nullptr) {
    return _open->wait();
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  return true;
}

}  // namespace line
