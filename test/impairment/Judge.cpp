#include "Judge.h"

#include <algorithm>
#include <iterator>

namespace {

constexpr uint64_t Tally::*Counts[] = {
    &Tally::damaged,    &Tally::intact,    &Tally::missed,        &Tally::wrong,
    &Tally::late,       &Tally::tooYoung,  &Tally::altered,       &Tally::disturbed,
    &Tally::outlived,   &Tally::lines,     &Tally::linesMissed,   &Tally::linesDead,
    &Tally::linesWrong, &Tally::linesLate, &Tally::linesTooYoung, &Tally::linesOutlived};

}  // namespace

Tally &Tally::operator+=(const Tally &other) {
  for (const auto count : Counts) {
    this->*count += other.*count;
  }
  return *this;
}

bool Tally::operator==(const Tally &other) const {
  return std::all_of(std::begin(Counts), std::end(Counts),
                     [&](uint64_t Tally::*count) { return this->*count == other.*count; });
}

void Tally::countLine() {
  lines = 1;
  linesMissed = missed != 0;
  linesDead = 2 * missed > intact;
  linesWrong = wrong != 0;
  linesLate = late != 0;
  linesTooYoung = tooYoung != 0;
  linesOutlived = outlived != 0;
}

void Judge::sent(const SentFrame &frame) {
  _entries.push_back({frame, _sent++, false});
  if (_broken) {
    _entries.back().frame.straight = false;
    _broken = false;
  }
  if (frame.size != _size) {
    _entries.back().frame.intact = false;
  }
  if (_entries.size() > Window) {
    settleOldest();
  }
}

void Judge::lost(uint64_t first, uint64_t after) {
  if (first == after) {
    return;
  }
  for (Entry &entry : _entries) {
    const bool hit = entry.frame.after > first && entry.frame.first < after;
    entry.frame.intact = entry.frame.intact && !hit;
  }
}

void Judge::broken() {
  _broken = true;
  for (Entry &entry : _entries) {
    entry.frame.straight = entry.frame.straight && entry.given;
  }
}

void Judge::poll(uint64_t position) {
  _hadBefore = _had;
  _had = position;
}

bool Judge::isThat(const uint8_t *frame, const LongFrame &sent) const {
  const unsigned flags = _size - 2;
  return std::equal(frame + 1, frame + flags, sent.begin() + 1) && ((frame[flags] ^ sent[flags]) & _flagsMask) == 0;
}

void Judge::given(const uint8_t *frame, uint64_t position, uint64_t sinceUs) {
  // Looks at the newest first: of equal frames that is the best for the receiver.
  for (size_t i = _entries.size(); i-- > 0;) {
    Entry &entry = _entries[i];
    if (entry.frame.intact && !entry.given && entry.frame.after <= position && position < entry.frame.after + Reach &&
        isThat(frame, entry.frame.bytes)) {
      entry.given = true;
      _firstGiven = std::min(_firstGiven, entry.number);
      _tally.altered += entry.frame.altered;
      _tally.tooYoung += entry.frame.endUs <= sinceUs;
      _tally.late += entry.frame.after <= _hadBefore && entry.frame.straight && i != 0 && _entries[i - 1].given;
      return;
    }
  }
  _tally.wrong++;
  _tally.outlived += _gap;
}

Tally Judge::finish() {
  while (!_entries.empty()) {
    settleOldest();
  }
  return _tally;
}

void Judge::settleOldest() {
  const Entry &entry = _entries.front();
  if (!entry.frame.intact || entry.frame.altered) {
    _tally.damaged++;
  } else {
    const bool learning = entry.number < _learning && entry.number < _firstGiven;
    const bool mayWait = entry.number + 1 == _sent && !(entry.frame.straight && _lastSettledGiven);
    _tally.intact++;
    _tally.missed += !entry.given && !learning && !mayWait;
  }
  _lastSettledGiven = entry.given;
  _entries.pop_front();
}
