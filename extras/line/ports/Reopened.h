// A port that may disappear and come back: an adapter that is unplugged and plugged in again. A pseudo-terminal never
// comes back: the next one with its name may belong to another program.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "line/ports/PortFile.h"

namespace line {

template <typename Port>
class Reopened {
 public:
  using Open = std::function<std::unique_ptr<Port>()>;

  // Opens the port. Throws std::runtime_error from `open`.
  Reopened(std::string device, Open open) : _device(std::move(device)), _open(std::move(open)), _port(_open()) {}

  // Returns the port; nullptr while it is gone. Retries from time to time.
  Port *at(uint64_t nowUs) {
    if (!_port && nowUs >= _retryUs && canComeBack()) {
      _retryUs = nowUs + RetryUs;
      reopen();
    }
    return _port.get();
  }

  // Notes that the port is gone.
  void gone() {
    _port.reset();  // while it is open, the system would give the adapter another name
    _news = _device + (canComeBack() ? ": the port is gone; plug the adapter in again to go on"
                                   : ": the program at the other end is gone");
  }

  // Returns true if it is gone and will not come back.
  bool finished() const { return !_port && !canComeBack(); }

  // See Line::news().
  std::string news() { return std::exchange(_news, {}); }

 private:
  static constexpr uint64_t RetryUs = 500000;

  bool canComeBack() const { return !isPseudoTerminal(_device); }

  void reopen() {
    try {
      _port = _open();
      _news = _device + ": the port is back";
    } catch (const std::runtime_error &) {
      // Try again: a port that has just come back may still belong to root.
    }
  }

  std::string _device;
  Open _open;
  std::unique_ptr<Port> _port;
  uint64_t _retryUs = 0;  // the time of the next attempt
  std::string _news;
};

}  // namespace line
