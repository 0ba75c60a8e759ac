/// @file
/// The Ticker of a Teensy 3, LC or 4: an IntervalTimer, at the lowest priority: other interrupts come first.
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
