/// @file
/// The Ticker of an RP2040 or RP2350 (arduino-pico): an alarm of the microsecond timer that nothing else uses, at the
/// lowest priority: other interrupts come first.
#pragma once

#include <Arduino.h>

namespace sbus {

// Its interrupt runs on the core that has called begin() first; decoders of the other core are not polled.
class Ticker : public AnyTicker {
 public:
  static constexpr bool canPoll(const SerialUART *) { return true; }
  static constexpr bool canPoll(const void *) { return false; }

  static bool start();
  static void stop();

  // If the sketch was interrupted within a method of the port, all of them return 0 here (CoreMutex.cpp:47): the line
  // would seem to be silent.
  static bool canRead(Port &port) { return port.available() != 0 || port.room() != 0; }
};

}  // namespace sbus
