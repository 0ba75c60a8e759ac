// A board's rows of numbers, judged as frames are.
#pragma once

#include <cstdint>
#include <vector>

#include "line/Statistics.h"
#include "line/recording/CsvRows.h"

namespace scope {

class BoardRows : public line::Arrivals {
 public:
  BoardRows();

  // Takes a character. Returns true if it has completed row().
  bool put(uint8_t byte, uint64_t nowUs);

  bool put(const line::Character &character) {
    return put(character.bad ? uint8_t{0} : character.value, character.endUs);
  }

  // Returns true if a board's numbers come, and nothing else since.
  bool recognised() const { return _rows.recognised(); }

  const line::CsvRow &row() const { return _rows.row(); }
  line::CsvKind kind(size_t column) const { return _rows.kind(column); }
  bool failsafe() const { return _failsafe; }
  bool lostFrame() const { return _lostFrame; }
  unsigned count() const { return _count; }
  unsigned otherLines() const { return _otherLines; }
  unsigned garbled() const { return _rows.garbled(); }

  // Returns the least and greatest value of a channel, from 0 on, in rows without a flag; nullptr before the first.
  struct Travel {
    double low;
    double high;
  };
  const Travel *travel(size_t channel) const { return channel < _travel.size() ? &_travel[channel] : nullptr; }
  void resetMarks() { _travel.clear(); }

 private:
  void mark();
  void waitFor(uint64_t nowUs);

  line::CsvRows _rows;
  bool _failsafe = false;
  bool _lostFrame = false;
  unsigned _count = 0;
  unsigned _otherLines = 0;
  uint64_t _newestUs = 0;
  uint64_t _longestUs = 0;  // from one row to the next
  std::vector<Travel> _travel;
};

}  // namespace scope
