// A receiver that is plugged in, or begins to listen, while frames come: does it join parts of two frames?
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "Simulation.h"

enum class Join {
  AtBegin,        // begin() while the line runs
  AfterSilence,   // plugged in after begin()
  AfterCut,       // in sync for 20 frames, unplugged, and plugged in again
  SameCharacter,  // likewise, at the character at which it was unplugged
  InStep,         // begin() while the line runs, with a loop in step with the frames
};

// One way to join, and the bounds, of all joins, for each kind of sticks.
struct JoinLine {
  std::string name;
  Join join;
  std::vector<Setup> setups;
  double misled;
  double unseen;
  const char *reason = "";
  Kind kind = Kind::Plain;

  // Frames that allow a false sync.
  static const std::vector<Payload> &sticks();
};

const std::vector<JoinLine> &joinLines();

// The results of a number of joins, with 30 frames each.
struct JoinTally {
  uint64_t joins = 0;
  uint64_t misled = 0;  // joins at which a frame was delivered that was never sent
  uint64_t unseen = 0;  // joins after which no frame was delivered
  Tally frames{};

  JoinTally &operator+=(const JoinTally &other);
};

// Frames that allow a false sync at each place, joined at each character, or at one of `stride`.
JoinTally impairment(const JoinLine &line, const Setup &setup, Payload sticks, Decoder decoder, unsigned stride,
                  uint64_t seed);

// Returns the stride for lines with this number of frames a case.
unsigned joinStride(uint64_t frames);
