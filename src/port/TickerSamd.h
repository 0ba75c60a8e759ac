/// @file
/// The Ticker of a SAMD: the core's tick of a millisecond, SysTick, asks for PendSV, which polls. No timer is taken.
#pragma once

#include <Arduino.h>

namespace sbus {

/// @cond  Not for sketches.

class Ticker : public AnyTicker {
 public:
  static bool start();
  static void stop();
};

/// @endcond

}  // namespace sbus
