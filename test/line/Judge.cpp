#include "Judge.h"

#include <algorithm>

#include <sbus/Frame.h>

namespace {

bool hasLowChannel16(const Frame &frame) {
  return sbus::isFlagsByte(frame[sbus::FlagsIndex - 1]);
}

}  // namespace

Tally &Tally::operator+=(const Tally &other) {
  damaged += other.damaged;
  intact += other.intact;
  missed += other.missed;
  wrong += other.wrong;
  noise += other.noise;
  late += other.late;
  lateDoubtful += other.lateDoubtful;
  blocked += other.blocked;
  outdated += other.outdated;
  outdatedDoubtful += other.outdatedDoubtful;
  return *this;
}

void Judge::sent(const SentFrame &frame) {
  _entries.push_back({frame, frame.intact, false});
  if (_entries.size() > Window) {
    settleOldest();
  }
}

void Judge::lost(uint64_t first, uint64_t behind) {
  if (first == behind) {
    return;
  }
  for (auto entry = _entries.rbegin(); entry != _entries.rend() && entry->frame.behind > first; ++entry) {
    if (entry->frame.first < behind) {
      entry->whole = false;
    }
  }
}

void Judge::given(const Frame &frame, uint64_t position) {
  // The newest first: of frames that are alike it is the best that can be said for a receiver.
  for (auto entry = _entries.rbegin(); entry != _entries.rend(); ++entry) {
    if (entry->whole && !entry->given && entry->frame.behind <= position &&
        std::equal(frame.begin(), frame.end() - 1, entry->frame.bytes.begin())) {
      entry->given = true;
      if (entry->frame.behind <= _lookBegin && _anyGiven && !hasLowChannel16(frame)) {
        (doubtful(frame) ? _tally.lateDoubtful : _tally.late)++;
      }
      _anyGiven = true;
      _lastGiven = frame;
      return;
    }
  }
  _tally.wrong++;
}

void Judge::lookEnds(uint64_t position, bool wasBlocked) {
  if (!wasBlocked) {
    return;
  }
  _tally.blocked++;
  for (auto entry = _entries.rbegin(); entry != _entries.rend(); ++entry) {
    if (entry->whole && entry->frame.behind <= position) {
      if (!entry->given && !hasLowChannel16(entry->frame.bytes)) {
        (doubtful(entry->frame.bytes) ? _tally.outdatedDoubtful : _tally.outdated)++;
      }
      return;
    }
  }
}

bool Judge::doubtful(const Frame &frame) const {
  return hasLowChannel16(_lastGiven) || _lastGiven[sbus::FlagsIndex] != frame[sbus::FlagsIndex];
}

Tally Judge::finish() {
  while (_entries.size() > LastFrames) {
    settleOldest();
  }
  return _tally;
}

void Judge::settleOldest() {
  const Entry &entry = _entries.front();
  if (entry.whole) {
    _tally.intact++;
    _tally.missed += !entry.given;
  } else {
    _tally.damaged++;
  }
  _entries.pop_front();
}
