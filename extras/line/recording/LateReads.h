// Finds the reads of a recording whose bytes were late although the port had said that it was empty: the adapter, USB
// or the system had stalled, not the program. After a time without bytes such bytes come faster than the line sends
// them, until they account for that time. If they do not, it was a silence.
#pragma once

#include <cstdint>
#include <deque>

#include "line/Line.h"

namespace line {

class LateReads {
 public:
  // Takes the next character, and appends those that are certain: after a time without bytes it holds them back for as
  // long as that was.
  void put(const Character &character, std::deque<Character> &characters);

  // Takes the end, and appends the rest.
  void finish(std::deque<Character> &characters);

 private:
  bool mayBeLate(const Character &character) const;
  bool accountsFor(uint64_t us) const;
  void measure(const Character &character);

  std::deque<Character> _held;
  bool _isHolding = false;
  uint64_t _lastUs = 0;    // the newest character's end; 0 before the first
  uint64_t _silentUs = 0;  // before those that are held
  uint64_t _fromUs = 0;    // when the measurement began; 0: with the next character
  uint64_t _count = 0;     // characters since then
  uint64_t _paceUs = 0;    // of _paceCount characters, as measured last; 0: never
  uint64_t _paceCount = 0;
};

}  // namespace line
