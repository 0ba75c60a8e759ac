// The telemetry slots of a line, from the stretches of an Observer.
#pragma once

#include <cstdint>
#include <vector>

#include "line/Segments.h"
#include "sbus/Slots.h"

namespace line {

class TelemetrySlots {
 public:
  using Slot = TimedSlot;

  // Takes the next stretch.
  void put(const Stretch &stretch);

  // Takes the end of the line: the slots after the last frame count as proved, since nothing else came.
  void finish();

  // Returns the slots that this stretch has proved: those before a frame, once that frame is there; of one moment, in
  // rising order. Mostly none.
  const std::vector<Slot> &proved() const { return _proved; }

  // Returns the slots that the next stretch consists of, if only slots came since the last frame; otherwise none. They
  // are proved once a frame follows.
  std::vector<Slot> slotsIn(const Stretch &stretch) const;

  // Returns true if a frame has announced a group.
  bool announced() const { return _announced; }

  // Returns how many times characters came between two frames and were just slots of the announced group.
  unsigned long groups() const { return _groups; }

  // Returns how many times the characters between two frames were not just slots of the announced group.
  unsigned long rejectedGroups() const { return _rejected; }

  // Returns how many slots were proved so far.
  unsigned long count() const { return _count; }

  // Returns how many characters are telemetry; of a group that is not proved yet, how many may be.
  unsigned long characters() const;

 private:
  static constexpr unsigned MostRejected = 64;  // groups with characters in a row, in 1 to 4 s

  int read(const std::vector<Character> &characters, sbus::Slot *slots, uint32_t &breaks) const;

  static std::vector<Slot> timed(const sbus::Slot *slots, int from, int to, const std::vector<Character> &characters);
  std::vector<Slot> prove();
  void takeProved();

  std::vector<Slot> _proved;
  std::vector<Character> _between;  // since the last frame
  uint8_t _end = 0;                 // its end byte
  bool _isWhole = false;            // nothing but characters came since, none with an error
  bool _announced = false;
  uint32_t _breaks = 0;  // see sbus::readSlots()
  unsigned _rejectedInRow = 0;
  unsigned long _groups = 0;
  unsigned long _rejected = 0;
  unsigned long _count = 0;
  unsigned long _characters = 0;  // of groups that are proved
};

}  // namespace line
