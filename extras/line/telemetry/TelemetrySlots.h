// The telemetry slots of a line, from the stretches of an Observer.
#pragma once

#include <cstdint>
#include <vector>

#include "line/Segments.h"
#include "sbus/Slots.h"

namespace line {

class TelemetrySlots {
 public:
  struct Slot : sbus::Slot {
    uint64_t endUs;  // of its last character
  };

  // Takes the next stretch. Returns the slots that it proves, those before a frame, in rising order; mostly none.
  std::vector<Slot> put(const Stretch &stretch);

  // Returns true if a frame has announced a group.
  bool announced() const { return _announced; }

  // Returns how many times the characters between two frames were not just slots of the announced group.
  unsigned long rejectedGroups() const { return _rejected; }

 private:
  std::vector<Slot> proved();

  std::vector<Character> _between;  // since the last frame
  uint8_t _end = 0;                 // its end byte
  bool _isWhole = false;            // nothing but characters came since, none of them bad
  bool _announced = false;
  unsigned long _rejected = 0;
};

}  // namespace line
