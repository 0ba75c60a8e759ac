// Extracts a line's telemetry slots from an Observer's stretches.
#pragma once

#include <cstdint>
#include <vector>

#include "line/Segments.h"
#include "sbus2/Slots.h"

namespace line {

class TelemetrySlots {
 public:
  // Takes the next stretch.
  void put(const Stretch &stretch);

  // Takes the end of the line: the slots after the last frame count as proved, since nothing follows them.
  void finish();

  // Returns the slots proved by this stretch: those before a frame, once that frame is there. They belong to one
  // moment, in rising order; usually there are none.
  const std::vector<TimedSlot> &proved() const { return _proved; }

  // Returns the slots in the next stretch, if there were only slots since the last frame; otherwise none. They are
  // proved once a frame follows.
  std::vector<TimedSlot> slotsIn(const Stretch &stretch) const;

  // Returns true if a frame has announced a group.
  bool announced() const { return _announced; }

  // Returns how many times the characters between two frames were exactly slots of the announced group.
  unsigned long groups() const { return _groups; }

  // Returns how many times they were not.
  unsigned long rejectedGroups() const { return _rejected; }

  // Returns the number of slots proved so far.
  unsigned long count() const { return _count; }

  // Returns the number of telemetry characters, including those of a group that is not proved yet.
  unsigned long characters() const;

 private:
  static constexpr unsigned MostRejected = 64;  // consecutive groups with characters, in 1 to 4 s

  int read(const std::vector<Character> &characters, sbus::Slot *slots, uint32_t &breaks) const;

  std::vector<TimedSlot> prove();
  void takeProved();

  std::vector<TimedSlot> _proved;
  std::vector<Character> _between;  // since the last frame
  uint8_t _end = 0;                 // its end byte
  bool _isWhole = false;            // only characters without errors since then
  bool _announced = false;
  uint32_t _breaks = 0;  // see sbus::readSlots()
  unsigned _rejectedInRow = 0;
  unsigned long _groups = 0;
  unsigned long _rejected = 0;
  unsigned long _count = 0;
  unsigned long _characters = 0;  // in proved groups
};

}  // namespace line
