// What a sketch must print, send and do at its pins for a line. Each row, sent frame and pulse must come from the
// newest frame on the line, or from the one before: the sketch may be busy, or it may not yet be certain where a frame
// ends.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "AvrBoard.h"
#include "sbus/Calibration.h"
#include "support/BitByBit.h"

namespace avr {

// Returns a line. "flight", "calibration": the simulated receiver; "cut": a flight that falls silent after 2 s;
// "noisy": one that is disturbed 20 times a second; "silent"; "wire": from TX1; otherwise a recording.
Line lineOf(const std::string &name);

// A frame of the line, read bit by bit: the library has no part in it.
struct SeenFrame {
  uint64_t us;  // when it is complete
  Channels channels;
  Channels held;  // of the newest frame without failsafe
  bool failsafe;
  bool lostFrame;
  unsigned number;  // 0: no frame has come yet
  unsigned others;  // intact characters before it that belong to no frame
  bool stale;       // no frame has come since, for 100 ms
};

using Numbers = std::vector<double>;

// What a sketch derives from a frame; empty: it must derive nothing.
using Rule = std::function<Numbers(const SeenFrame &)>;

Numbers decodeSBus(const SeenFrame &frame);
Numbers allChannels(const SeenFrame &frame);
Numbers normalized(const SeenFrame &frame);
Rule calibrated(const sbus::Calibration &calibration);
Numbers servos(const SeenFrame &frame);
Numbers mixer(const SeenFrame &frame);
Numbers mixerSends(const SeenFrame &frame);  // numbersOf() the frame
Numbers counters(const SeenFrame &frame);

// Returns the channels, then the rest of the bytes 23, 0 and 24.
Numbers numbersOf(const Frame &frame);

// Reads "172,992", without its end; empty for any other text.
Numbers numbersIn(const std::string &row);

// Prints a row of a table of extras/docs/measured.md: figures.sh compares it.
void figure(const std::string &what, const std::string &value);

// Returns "0.1" or the like.
std::string rounded(double value, int places);

// What the line of a run requires.
class Expected {
 public:
  explicit Expected(const std::vector<line::Character> &characters);

  // Returns what is wrong with `found`, made at `us`; empty if it is what one of the two frames requires.
  std::string wrong(uint64_t us, const Numbers &found, const Rule &rule, double tolerance) const;

  // Returns the number of frames that began at `fromUs` or later, and were complete by `toUs`.
  unsigned count(uint64_t fromUs, uint64_t toUs) const;

 private:
  std::vector<SeenFrame> _frames;
};

}  // namespace avr
