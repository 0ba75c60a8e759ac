// The impaired lines for receivers, and the bounds for ours on each.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "Simulation.h"

// Frames per impaired frame, noise character and blocked loop; otherwise per intact frame. The bounds hold for all setups
// and all sticks of a group together. No frame may be late or too young.
constexpr double NotBound = 1e9;  // only printed
struct Limits {
  double missed;
  double wrong;
  const char *reason = "";  // why these are not the usual bounds
};

struct Condition {
  std::string name;
  Run run;
  std::vector<Setup> setups;
  Limits ordinary;
  Limits deceptive;
  std::vector<Payload> only = {};  // empty: all
  uint64_t most = UINT64_MAX;      // frames of each setup and kind of sticks

  std::vector<Payload> sticks() const;
};

const std::vector<Condition> &conditions();

// One condition, one setup, one kind of sticks: `frames` or a few more. Each has a seed of its own, made of `seed`.
Tally impairment(const Condition &condition, const Setup &setup, Payload sticks, Decoder decoder, uint64_t frames,
              uint64_t seed);
