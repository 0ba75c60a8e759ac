/// @file
/// How a decoder is polled when loop() alone polls it.
#pragma once

namespace sbus {

// loop() polls, or the port calls back (Listener.h). PolledByTimer does by a timer instead (Ticker.h), and has the same
// members.
struct PolledByLoop {
  // Keeps other contexts from polling, while it exists.
  struct Lock {
    explicit Lock(const PolledByLoop &) {}
  };

  // Fails to compile if a port of this class cannot be polled in this way.
  template <typename Port>
  static void check() {}

  template <typename Decoder>
  static void startPolling(Decoder &) {}
  static void stopPolling() {}
};

}  // namespace sbus
