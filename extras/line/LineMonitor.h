// What goes over a line, whether somebody receives it or not.
#pragma once

#include <array>

#include "Line.h"
#include "sbus/FrameFinder.h"

namespace line {

// It hands the characters over as most ports do: 16 at once, or as many as there are when the line falls idle or a
// character is bad.
class LineMonitor {
 public:
  // Begins anew on a line whose characters take so long.
  void reset(uint64_t nowUs, uint32_t characterUs);

  void put(const Character &character);

  // Nothing else has come up to now.
  void idleUntil(uint64_t nowUs);

  unsigned long characters() const { return _characters; }
  unsigned long badCharacters() const { return _badCharacters; }
  // True if frames have 24 channels, not 16.
  bool has24() const { return _finder24.counters().frames > _finder.counters().frames; }
  const sbus::Counters &counters() const { return has24() ? _finder24.counters() : _finder.counters(); }

 private:
  void resetFinders(uint64_t nowUs, uint32_t characterUs);
  void handOver(uint64_t nowUs);

  std::array<uint8_t, 16> _burst{};
  size_t _waiting = 0;  // bytes of it
  sbus::FrameFinder _finder;
  sbus::FrameFinderOf<sbus::Frame24> _finder24;
  uint32_t _characterUs = CharacterUs;
  uint64_t _lastEndUs = 0;
  unsigned long _characters = 0;
  unsigned long _badCharacters = 0;
};

}  // namespace line
