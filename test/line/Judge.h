// Holds what a sketch was given against what stood on the wire.
#pragma once

#include <cstdint>
#include <deque>

#include "WireLine.h"

struct Tally {
  uint64_t damaged = 0;  // frames that did not reach the sketch whole: damaged on the wire, or the buffer was full
  uint64_t intact = 0;   // all others
  uint64_t missed = 0;   // of these: never given to the sketch
  uint64_t wrong = 0;    // given to the sketch, but never on the wire as a frame, at its true place
  uint64_t noise = 0;    // characters in pauses

  // Without the frames whose CH16 is below 128, which always wait for what follows (DecodeSBus.h), and without the
  // first frame. Doubtful are those whose predecessor was of that kind, or had other flags: they look damaged.
  uint64_t late = 0;              // given later than at the first look at its last byte
  uint64_t lateDoubtful = 0;      // the same, of the doubtful ones
  uint64_t blocked = 0;           // looks after a blocked loop()
  uint64_t outdated = 0;          // of these: the newest whole frame was not the one given
  uint64_t outdatedDoubtful = 0;  // the same, of the doubtful ones

  Tally &operator+=(const Tally &other);

  // What a loss is held against: a damaged frame, or a noise character.
  uint64_t damages() const { return damaged + noise; }
};

// Characters are numbered as in SentFrame: those that the port could receive.
class Judge {
 public:
  // The wire brings `frame`, later than all before.
  void sent(const SentFrame &frame);

  // The characters from `first` on, up to but without `behind`, never reached the sketch.
  void lost(uint64_t first, uint64_t behind);

  // A look begins at character `position`.
  void lookBegins(uint64_t position) { _lookBegin = position; }

  // The sketch has been given `frame` when it had read all characters before `position`. Its end byte is not looked at.
  void given(const Frame &frame, uint64_t position);

  // The look is over: all characters before `position` are read.
  void lookEnds(uint64_t position, bool wasBlocked);

  // The sum, without the line's last frames: what follows them is missing.
  Tally finish();

 private:
  struct Entry {
    SentFrame frame;
    bool whole;
    bool given;
  };

  void settleOldest();
  bool doubtful(const Frame &frame) const;

  static constexpr size_t Window = 128;  // frames: half a second of the densest line
  static constexpr size_t LastFrames = 3;

  std::deque<Entry> _entries;
  uint64_t _lookBegin = 0;
  bool _anyGiven = false;
  Frame _lastGiven{};
  Tally _tally;
};
