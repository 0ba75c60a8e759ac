/// @file
/// Tells a sketch what a port can do; extras/docs/boards.md lists the results for each board.
#pragma once

#include "port/Port.h"

namespace sbus {

/// Returns true if begin() opens this port inverted; otherwise the line needs an inverter, or the sketch that opens the
/// port inverts it.
template <typename Port>
constexpr bool inverts(Port &) {
  return KindOf<Port>::Inverts;
}

/// Returns true if begin() can open this port inverted and uninverted, any number of times: on an ESP32 or ESP8266 on
/// the pins given to DecodeSBus's constructor, or on the core's.
template <typename Port>
constexpr bool opensBothWays(Port &) {
  return KindOf<Port>::BothWays;
}

}  // namespace sbus
