// Suggests what may be wrong while there are no frames from a real port.
#pragma once

#include <cstdint>
#include <string>

#include "line/Observer.h"

namespace host {

class PortWatch {
 public:
  // `device` is empty if there is no real port: then check() returns nothing.
  PortWatch(const std::string &device, const line::Observer &observer) : _device(device), _observer(observer) {}

  // Returns a message to print now, or nothing. Call it at any rate.
  std::string check(uint64_t nowUs);

 private:
  static constexpr uint64_t PeriodUs = 3000000;

  const std::string &_device;
  const line::Observer &_observer;
  uint64_t _nextUs = 0;
  unsigned long _characters = 0;  // at the last check
  unsigned long _frames = 0;
};

}  // namespace host
