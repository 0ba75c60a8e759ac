// On how many lines something went wrong, and how many the rates allow.
//
// Lines are independent of each other, the frames of a line are not: so lines are counted. Rates.inc has the counts of
// a long run, and each rate its 95 % interval. A bound is the count that one run in a million would exceed if the true
// rate were the upper end of that interval. What is expected on less than one line of a condition is also summed up
// over all conditions, and the sum has a bound.
#pragma once

#include <string>
#include <vector>

#include "Conditions.h"

// One condition with one group of sticks.
struct Group {
  const Condition *condition;
  const char *name;  // of the sticks
  std::vector<Payload> sticks;
};

// Returns those whose condition's name contains `only`.
std::vector<Group> groups(const std::string &only = "");

// Runs lines of the group, `frames` frames with each kind of sticks.
Tally impairment(const Group &group, uint64_t frames, uint64_t seed);

// A number of lines of all of them.
struct Rate {
  uint64_t count = 0;
  uint64_t lines = 0;

  // The ends of the interval which contains the true rate in 95 of 100 cases: those of a Poisson distribution.
  double low() const;
  double high() const;
};

struct Check {
  std::string line;  // condition and sticks
  std::string what;
  Rate seen;
  Rate measured;
  uint64_t most;           // of seen.count
  std::string parts = {};  // of a sum
};

// Returns what is to be checked where `tallies[i]` is `groups[i]`'s. A group without rates is a std::out_of_range.
std::vector<Check> checks(const std::vector<Group> &groups, const std::vector<Tally> &tallies);

// Prints Rates.inc with these tallies; groups that are not among these stay as they are.
void printRates(const std::vector<Group> &groups, const std::vector<Tally> &tallies);
