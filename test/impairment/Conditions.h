// The impaired lines, and what our receiver promises on them. Rates.inc has what it has been measured to do.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "Simulation.h"

// Only what follows from the rules, whatever is drawn: on a whole line the parts of two frames have an end byte and a
// header inside, and where every gap is seen nothing but a frame stands between two.
enum class Promise {
  None,        // the measured rates are all
  NeverWrong,  // no frame is wrong or too young, at any seed
  Faultless,   // nor is any missed or late
};

// Lines that have something in common. What differs is drawn for each line.
struct Condition {
  std::string name;
  Run run;
  std::vector<Setup> setups;
  Promise promise = Promise::None;
  std::vector<Payload> only = {};  // sticks; empty: all
  void (*vary)(Run &run, Random &random) = nullptr;

  std::vector<Payload> ordinarySticks() const;
  std::vector<Payload> deceptiveSticks() const;
};

// Returns them all.
const std::vector<Condition> &conditions();

// Return the parts: lines with more than frames, such as telemetry, stray characters, a loop() with delays, a loose
// connector; ...
const std::vector<Condition> &companyLines();
// ... a receiver that is plugged in, or begins to listen, while frames come: does it join parts of two? Each line is
// one join, with 30 frames that allow a false sync at any place; ...
const std::vector<Condition> &joinLines();
// ... senders that are not exact: frames that are spread or interrupted, noise before them, another receiver in mid
// frame.
const std::vector<Condition> &senderLines();
// Returns those that stretch frames, each with each period of loop().
const std::vector<Condition> &stretchedLines();

// Sums up lines with `frames` frames, or a few more, for each of these sticks. A line's setup is one of these, drawn
// like all that differs: the lines are independent of each other.
Tally impairment(const Condition &condition, const std::vector<Setup> &setups, const std::vector<Payload> &sticks,
                 Decoder decoder, uint64_t frames, uint64_t seed);
