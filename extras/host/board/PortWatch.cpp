#include "PortWatch.h"

namespace host {

std::string PortWatch::check(uint64_t nowUs) {
  if (_device.empty() || nowUs < _nextUs) {
    return {};
  }
  const bool first = _nextUs == 0;
  const bool characters = _observer.characters() != _characters;
  const bool frames = _observer.counters().frames != _frames;
  _nextUs = nowUs + PeriodUs;
  _characters = _observer.characters();
  _frames = _observer.counters().frames;
  if (first) {
    return "waiting for frames from " + _device;
  }
  const std::string time = std::to_string(nowUs / 1000000) + " s: ";
  if (!characters) {
    return time + "no bytes from " + _device +
           ". Is it the right port, the receiver powered and bound, S-BUS_OUT at RXD, GND at GND?";
  }
  return frames ? "" : time + "no frames in the bytes from " + _device +
                           ". Is the adapter's RXD inverted? See extras/docs/ftdi.md";
}

}  // namespace host
