// Whether a wire carries S.Bus, which way up it is and how fast, told from its edges.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "line/simulation/LineSettings.h"
#include "line/capture/Overrules.h"

namespace line {

// From `ns` on the wire is so.
struct Level {
  int64_t ns;
  bool high;
};

// The clocks of receiver and analyser differ by this part of 100000 or 200000 baud at most.
constexpr double BaudTolerance = 0.03;

constexpr uint64_t SilenceUs = 10000;  // after a capture that ends with an edge; a last frame waits for 3 ms of it

struct FoundWire {
  LineSettings settings;  // Inverted or Uninverted
  double bitNs = 0;       // as measured
  unsigned good = 0;      // characters of the sample with parity and stop bit right
  unsigned bad = 0;
  unsigned long frames = 0;  // of the sample: a wire without any carries no S.Bus
  unsigned channels = 16;    // 16, 24 or 32, as the frames have

  // Returns true if most characters of the sample have a right parity and stop bit. Other lines' characters may have, as well.
  bool hasCharacters() const { return good >= 4 && good >= 2 * bad; }
  double share() const { return good == 0 ? 0 : static_cast<double>(good) / (good + bad); }
  // By how much the wire is faster than it should be: 0.01 is 1 %.
  double deviation() const { return 1e9 / bitNs / static_cast<double>(settings.baud) - 1; }

  // Returns true if `other` has fewer frames, or as many but more errors.
  bool betterThan(const FoundWire &other) const {
    return frames != other.frames ? frames > other.frames : share() > other.share();
  }
};

// Returns what fits best, which may have neither frames nor characters. `levels`: each differs from the one before, the
// first is where the sample begins. Only the overrules' baud rate and polarity are tried.
FoundWire findWire(const std::vector<Level> &levels, const Overrules &overrules = {});

bool hasPulses(const std::vector<Level> &levels);

// Returns true if the shortest pulses last a bit of 100000 or 200000 baud.
bool hasBits(const std::vector<Level> &levels);

// Returns what a wire without frames carries instead. `periodNs`: between two samples, 0 if it is not known.
std::string whyNotFound(const std::vector<Level> &levels, const FoundWire &best, double periodNs);

// What is looked for, for messages that nothing was found.
constexpr const char *FrameForm =
    "a frame is 25 characters (36 of 24 channels), 8E2 at 100000 or 200000 baud, from 0F to an end byte, after a gap";

// Empty if the samples were close enough to tell the bits of a character.
std::string tooSlow(double sampledNs, double bitNs);

}  // namespace line
