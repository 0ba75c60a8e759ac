/// @file
/// Keeps the newest frame with extra channels (header 2F), from the events of a FrameFinder.
#pragma once

#include <stdint.h>
#include <string.h>

#include "FrameFinder.h"

namespace sbus {

/// Holds the newest frame with header 2F, and when it came. The context that reads the port calls the events; they may
/// interrupt the other methods.
class ExtraFrame : public NoEvents {
 public:
  /// Returns how many frames have come, modulo 2^32. Use what you read only if it has not changed meanwhile.
  uint32_t count() const { return _count; }

  /// Returns true if none has come, or the newest was forgotten.
  bool isForgotten() const { return _forgotten == _count; }

  /// Returns the newest frame, 25 bytes; undefined before the first.
  const uint8_t *bytes() const { return _bytes; }

  /// Returns the FrameFinder::frameTime() of the newest frame, us; undefined before the first.
  uint32_t time() const { return _time; }

  /// Forgets frame number `count`, unless a newer one has come.
  void forget(uint32_t count) { _forgotten = count; }

  /// Forgets the newest frame: it came before a time that nothing has measured.
  void forgetAll() { _forgotten = _count; }

  // The events of a FrameFinder.
  void begin() { forgetAll(); }  ///< see NoEvents
  /// See NoEvents.
  void extra(const uint8_t *frame, uint32_t time) {
    memcpy(_bytes, frame, FrameSize);
    _time = time;
    _count++;
  }

 private:
  uint32_t _count = 0;
  uint32_t _forgotten = 0;
  uint32_t _time;
  uint8_t _bytes[FrameSize];
};

}  // namespace sbus
