// The lines on which receivers are put to the torture, and what ours is held to on each.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "Bench.h"

constexpr unsigned long FastBaud = 200000;

struct Timing {
  uint32_t periodUs;
  uint32_t loopUs;
};

// Per damaged frame and per noise character; on a line that has neither, per intact frame. `reason` says why it is more
// than issue 3 asks for; empty if it is not, or if the issue does not say.
struct Bound {
  std::vector<Sticks> sticks;  // all of these and all timings together
  double missed;
  double wrong;
  const char *reason;
};

struct Condition {
  std::string name;
  Impairments impairments;
  Kind kind;
  std::vector<Timing> timings;
  std::vector<Bound> bounds;
  uint32_t blockUs = 0;
  bool joining = false;
  bool byteByByte = false;
  bool inStep = false;  // every pass takes exactly as long, and looks meet each frame at the same place
  unsigned long baud = sbus::Baud;
};

const std::vector<Condition> &conditions();

// One condition, one timing, one kind of sticks.
Run runOf(const Condition &condition, const Timing &timing, Sticks sticks);

// The same: `frames` or a few more. Each has a seed of its own, made of `seed`.
Tally torture(const Condition &condition, const Timing &timing, Sticks sticks, Way way, uint64_t frames, uint64_t seed);

// "T = 9 ms, loop() 50 us".
std::string name(const Timing &timing);
