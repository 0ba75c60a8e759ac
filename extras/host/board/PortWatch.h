// Says what is amiss while a real port brings no frames.
#pragma once

#include <cstdint>
#include <string>

#include "line/Observer.h"

namespace host {

class PortWatch {
 public:
  // `device`: empty if there is no real port; then nothing is said.
  PortWatch(const std::string &device, const line::Observer &observer) : _device(device), _observer(observer) {}

  // What is to be said now, or nothing. Call it as often as you like.
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
