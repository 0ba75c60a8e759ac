// Compares the frames that a sketch was given with those on the line.
#pragma once

#include <cstdint>
#include <deque>

#include "ImpairedLine.h"

struct Tally {
  uint64_t damaged = 0;    // frames that did not reach the sketch whole: damaged on the line, or the buffer was full
  uint64_t intact = 0;     // all others
  uint64_t missed = 0;     // intact frames that were never given to the sketch
  uint64_t wrong = 0;      // given to the sketch, but never on the line as a frame, at its true place
  uint64_t late = 0;       // in sync, and given later than at the first poll that had its last byte
  uint64_t tooYoung = 0;   // given with an age below the time since its last character was complete
  uint64_t altered = 0;    // damaged, and given: all its characters were there, and it looked like a frame
  uint64_t disturbed = 0;  // characters in gaps, and blocked loops
  uint64_t outlived = 0;   // wrong, and given after a gap that can be seen: false sync should have ended there

  // On how many lines that happened.
  uint64_t lines = 0;
  uint64_t linesMissed = 0;
  uint64_t linesDead = 0;  // more than half of the intact frames were missed
  uint64_t linesWrong = 0;
  uint64_t linesLate = 0;
  uint64_t linesTooYoung = 0;
  uint64_t linesOutlived = 0;

  Tally &operator+=(const Tally &other);
  bool operator==(const Tally &other) const;

  // Returns what a loss is compared with.
  uint64_t damages() const { return damaged + disturbed; }

  // Counts all this as one line.
  void countLine();
};

// Characters are numbered as in SentFrame: those that the port could receive.
//
// In sync is a frame that stands straight after one that was given, with no break in between. Not counted as missed are
// the first `learning` frames, as long as none was given, and a last one that is not in sync: it may wait for what
// follows.
class Judge {
 public:
  // Judges frames of `size` bytes; others are damaged. Only the flags of `flagsMask` are given to the sketch.
  Judge(uint64_t learning, unsigned size, unsigned flagsMask)
      : _learning(learning), _size(size), _flagsMask(flagsMask) {}

  // Takes a `frame` of the line, later than all before.
  void sent(const SentFrame &frame);

  // Notes that the characters from `first` on, up to but without `after`, never reached the sketch.
  void lost(uint64_t first, uint64_t after);

  // Notes that the receiver assumes a loss of characters in the port.
  void broken();

  // Notes that a gap which a receiver can see has been on the line since it was joined.
  void gap() { _gap = true; }

  // Takes a poll, which has all characters before `position`.
  void poll(uint64_t position);

  // Takes the `frame` that the sketch was given when it had read all characters before `position`. By its age the
  // frame's last character was complete after `sinceUs`. Header and end byte are not compared.
  void given(const uint8_t *frame, uint64_t position, uint64_t sinceUs = 0);

  // Returns the tally.
  Tally finish();

 private:
  struct Entry {
    SentFrame frame;
    uint64_t number;
    bool given;
  };

  bool isThat(const uint8_t *frame, const LongFrame &sent) const;
  void settleOldest();

  static constexpr size_t Window = 128;   // frames: half a second of the densest line
  static constexpr uint64_t Reach = 100;  // characters: a frame that is given later is another one that looks the same

  const uint64_t _learning;
  const unsigned _size;
  const unsigned _flagsMask;
  std::deque<Entry> _entries;
  uint64_t _sent = 0;
  uint64_t _firstGiven = UINT64_MAX;  // number of the frame
  bool _gap = false;
  bool _broken = false;  // since the newest frame began
  bool _lastSettledGiven = false;
  uint64_t _had = 0;        // the newest poll has, or has read, all characters before this
  uint64_t _hadBefore = 0;  // _had of the poll before
  Tally _tally;
};
