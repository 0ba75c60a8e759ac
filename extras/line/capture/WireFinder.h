// Finds by its edges whether a wire carries S.Bus, its polarity and its baud rate.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "line/LineSettings.h"
#include "line/capture/Overrules.h"

namespace line {

// The level of the wire from `ns` on.
struct Level {
  int64_t ns;
  bool high;
};

// The most by which the clocks of receiver and analyser differ, as a part of 100000 or 200000 baud.
constexpr double BaudTolerance = 0.03;

constexpr uint64_t SilenceUs = 10000;  // assumed after a capture that ends with an edge; a last frame needs 3 ms

struct FoundWire {
  LineSettings settings;  // Inverted or Uninverted
  double bitNs = 0;       // as measured
  unsigned good = 0;      // characters of the sample with parity and stop bit right
  unsigned bad = 0;
  unsigned long frames = 0;  // of the sample: a wire without any carries no S.Bus
  unsigned channels = 16;    // 16, 24 or 32, as the frames have

  // Returns true if most characters of the sample have a right parity and stop bit. Those of other lines may have it
  // too.
  bool hasCharacters() const { return good >= 4 && good >= 2 * bad; }
  double share() const { return good == 0 ? 0 : static_cast<double>(good) / (good + bad); }
  // Returns by how much the wire is too fast: 0.01 is 1 %.
  double deviation() const { return 1e9 / bitNs / static_cast<double>(settings.baud) - 1; }

  // Returns true if `other` has fewer frames, or as many but more errors.
  bool betterThan(const FoundWire &other) const {
    return frames != other.frames ? frames > other.frames : share() > other.share();
  }
};

// Returns the wire that fits best, which may have neither frames nor characters. Each of the `levels` differs from the
// one before; the first is where the sample begins. It tries only the baud rate and polarity that `overrules` allow.
FoundWire findWire(const std::vector<Level> &levels, const Overrules &overrules = {});

bool hasPulses(const std::vector<Level> &levels);

// Returns true if the shortest pulses last a bit of 100000 or 200000 baud.
bool hasBits(const std::vector<Level> &levels);

// Returns what a wire without frames carries instead. `periodNs`: between two samples, 0 if it is not known.
std::string whyNotFound(const std::vector<Level> &levels, const FoundWire &best, double periodNs);

// Says what a frame is, for messages that there was none.
constexpr const char *FrameForm =
    "a frame is 25 characters (36 of 24 channels), 8E2 at 100000 or 200000 baud, from 0F to an end byte, after a gap";

// Returns that the samples are too far apart to tell the bits of a character; "" if they are not.
std::string tooSlow(double sampledNs, double bitNs);

}  // namespace line
