/// @file
/// The Ticker of a Teensy 3, LC or 4: an IntervalTimer, at the lowest priority: other interrupts come first.
///
/// Not part of the interface: it may change in any release.
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
