// The lines on which receivers are put to the torture, and what ours is held to on each.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "Simulation.h"

constexpr unsigned long FastBaud = 200000;

// Frames per damaged frame, noise character and blocked loop; where there are none of these, per intact frame. They
// hold for all setups and all sticks of a group together. Late are none.
constexpr double NotBound = 1e9;  // only printed
struct Limits {
  double missed;
  double wrong;
  const char *reason = "";  // why they are not the usual ones
};

struct Condition {
  std::string name;
  Run run;
  std::vector<Setup> setups;
  Limits ordinary;
  Limits deceptive;
  std::vector<Payload> only = {};  // else all

  std::vector<Payload> sticks() const;
};

const std::vector<Condition> &conditions();

// One condition, one setup, one kind of sticks: `frames` or a few more. Each has a seed of its own, made of `seed`.
Tally torture(const Condition &condition, const Setup &setup, Payload sticks, Decoder decoder, uint64_t frames, uint64_t seed);

// "T 9 ms, loop 50 us, board, 64".
std::string name(const Setup &setup);
