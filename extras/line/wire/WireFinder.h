// Which way up a wire is and how fast, told from its edges.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "../LineSettings.h"

namespace line {

// From `ns` on the wire is so.
struct Level {
  int64_t ns;
  bool high;
};

// The clocks of receiver and analyser differ by so much at the most, of 100000 or 200000 baud.
constexpr double BaudTolerance = 0.03;

struct FoundWire {
  LineSettings settings;  // 100000 or 200000 baud, Inverted or Uninverted
  double bitNs = 0;       // as measured
  unsigned good = 0;      // characters of the sample with parity and stop bit right
  unsigned bad = 0;

  bool found() const { return good >= 4 && good >= 2 * bad; }
  double share() const { return good == 0 ? 0 : static_cast<double>(good) / (good + bad); }
  // By how much the wire is faster than it should be: 0.01 is 1 %.
  double deviation() const { return 1e9 / bitNs / static_cast<double>(settings.baud) - 1; }
};

// What fits best; found() tells whether it does. `levels`: each differs from the one before, the first is where the
// sample begins.
FoundWire findWire(const std::vector<Level> &levels);

// Why it does not: what the wire carries instead. `periodNs`: between two samples, 0 if it is not known.
std::string whyNotFound(const std::vector<Level> &levels, const FoundWire &best, double periodNs);

// Empty if the samples were close enough to tell the bits of a character.
std::string tooSlow(double sampledNs, double bitNs);

}  // namespace line
