// Finds out from its edges whether a wire carries S.Bus, with which polarity and baud rate.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "line/LineSettings.h"
#include "line/capture/Capture.h"
#include "sbus/Diagnosis.h"

namespace line {

// The level of the wire from `ns` on.
struct Level {
  int64_t ns;
  bool high;
};

constexpr uint64_t EndSilenceUs = 10000;  // assumed after a capture that ends with an edge; a frame needs 3 ms

struct FoundWire {
  LineSettings settings;  // Inverted or Uninverted
  double bitNs = 0;       // as measured
  unsigned good = 0;      // characters of the sample with correct parity and stop bit
  unsigned bad = 0;
  unsigned long frames = 0;                          // in the sample; without any the wire does not carry S.Bus
  unsigned channels = 16;                            // of the frames: 16, 24 or 32
  sbus::Finding protocol = sbus::Finding::NoSignal;  // Observer::otherProtocol()

  // Returns true if most characters of the sample have correct parity and stop bits, which may also happen on other
  // lines.
  bool hasCharacters() const { return good >= 4 && good >= 2 * bad; }
  double share() const { return good == 0 ? 0 : static_cast<double>(good) / (good + bad); }
  // Returns how much too fast the wire is: 0.01 is 1 %.
  double deviation() const { return 1e9 / bitNs / static_cast<double>(settings.baud) - 1; }

  // Returns true if `other` has fewer frames, or equally many but more errors.
  bool betterThan(const FoundWire &other) const {
    return frames != other.frames ? frames > other.frames : share() > other.share();
  }
};

// Returns the best fit, which may have neither frames nor characters. Each of the `levels` differs from the previous
// one; the first is where the sample begins. It tries only the baud rate that `overrides` allow.
FoundWire findWire(const std::vector<Level> &levels, const Overrides &overrides);

bool hasPulses(const std::vector<Level> &levels);

// Returns true if the shortest pulses last one bit at 100000 or 200000 baud.
bool hasBits(const std::vector<Level> &levels);

// Returns what a wire without frames carries instead. `periodNs`: the time between two samples; 0 if unknown.
std::string whyNotFound(const std::vector<Level> &levels, const FoundWire &best, double periodNs);

// Defines a frame, for messages about missing frames.
constexpr const char *FrameForm =
    "a frame is 25 characters (36 with 24 channels), 8E2 at 100000 or 200000 baud, from 0F to an end byte, after a gap";

// Returns the error that the samples are too far apart to tell a character's bits; "" if they are not.
std::string tooSlow(double sampledNs, double bitNs);

}  // namespace line
