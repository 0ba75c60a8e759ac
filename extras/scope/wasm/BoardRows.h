// A board's rows of numbers, judged as frames are.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "line/CsvRows.h"
#include "line/Observer.h"

namespace scope {

class BoardRows {
 public:
  void reset();

  // True if it has completed a row: row() is it.
  bool put(uint8_t byte, uint64_t nowUs);

  bool put(const line::Character &character) {
    return put(character.bad ? uint8_t{0} : character.value, character.endUs);
  }

  // A board's numbers come; nothing else since.
  bool recognised() const { return _rows.recognised(); }

  const line::CsvRow &row() const { return _rows.row(); }
  bool failsafe() const { return _failsafe; }
  bool lostFrame() const { return _lostFrame; }
  sbus::LinkState state(uint64_t nowUs);
  uint64_t ageUs(uint64_t nowUs) const { return nowUs > _lastUs ? nowUs - _lastUs : 0; }
  unsigned perSecond(uint64_t nowUs) const;
  unsigned count() const { return _count; }
  unsigned otherLines() const { return _otherLines; }
  const line::Extent &gaps() const { return _gaps; }

  // Least and most of a channel, from 0 on, in rows without a flag; nullptr before the first.
  struct Travel {
    double low;
    double high;
  };
  const Travel *travel(size_t channel) const { return channel < _travel.size() ? &_travel[channel] : nullptr; }
  void resetMarks() { _travel.clear(); }

 private:
  void mark();

  line::CsvRows _rows;
  sbus::Link _link;
  bool _failsafe = false;
  bool _lostFrame = false;
  uint64_t _lastUs = 0;
  unsigned _count = 0;
  unsigned _otherLines = 0;
  line::Extent _gaps;
  std::deque<uint64_t> _lately;
  std::vector<Travel> _travel;
};

}  // namespace scope
