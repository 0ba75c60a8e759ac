// Summarises a flight: frames, periods of failsafe, losses and silence, worst seconds, curves. Its size does not grow
// with the number of frames.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "line/DetectedVariant.h"
#include "line/FrameRate.h"
#include "line/Jumps.h"
#include "line/Segments.h"
#include "line/report/Curves.h"
#include "line/report/FlagSpans.h"

namespace line {

// A second of the flight.
struct FlightSecond {
  unsigned frames = 0;
  unsigned lost = 0;      // with the lost-frame flag
  unsigned failsafe = 0;  // in failsafe, or without pulses
};

// A frame, as an Observer has found it.
struct FlightFrame {
  Stretch::Kind kind;
  uint8_t end;  // its end byte
  uint64_t us;
  uint32_t lateUs;
  bool failsafe, lost, pulseless;
  std::array<uint16_t, 32> channels;  // raw values
  size_t count;                       // of channels
};

// The whole line's.
struct FlightCounts {
  unsigned long frames, lostFrames, failsafeFrames, discardedBytes, characterErrors;
};

class FlightLog {
 public:
  // `zeroUs`: the source's own time at time 0; not above 0.
  explicit FlightLog(int64_t zeroUs = 0) : _zeroUs(zeroUs) {}

  // Takes the time of a character, or of silence: the line begins with the first and ends with the last.
  void heard(uint64_t us, bool isSilence = false);

  void put(const FlightFrame &frame);
  void finish(const FlightCounts &counts);

  // Returns the counts, after finish().
  const FlightCounts &counts() const { return _counts; }
  std::string variant() const { return _variant.text(); }
  // Return the time of the first and of the last frame.
  uint64_t firstUs() const { return _flags.firstUs(); }
  uint64_t lastUs() const { return _flags.lastUs(); }
  // Return, after finish(), when the flight begins and ends: with these frames, unless the line has none for 0.1 s
  // before or after them.
  uint64_t fromUs() const { return _fromUs; }
  uint64_t toUs() const { return _toUs; }
  // Returns, after finish(), in a sentence for how long the line has no frame at its end; "" if it has.
  std::string endText() const;

  // Returns a time of this flight in the source's own time.
  int64_t shownUs(uint64_t us) const { return static_cast<int64_t>(us) + _zeroUs; }

  // Returns the spans of a kind in order.
  std::vector<FlagSpan> spans(FlagSpan::Kind kind) const;

  // Returns the seconds with frames, by number.
  const std::map<uint64_t, FlightSecond> &seconds() const { return _seconds; }

  const FrameRate &rate() const { return _rate; }
  const Curves &curves() const { return _curves; }

 private:
  const int64_t _zeroUs;
  uint64_t _fromUs = UINT64_MAX;
  uint64_t _toUs = 0;
  uint64_t _byteUs = 0;    // the newest character
  uint64_t _silentUs = 0;  // the longest time without one since the newest frame
  FlightCounts _counts{};
  DetectedVariant _variant;
  FlagSpans _flags;
  Jumps _jumps;
  FrameRate _rate;
  std::map<uint64_t, FlightSecond> _seconds;
  Curves _curves;
};

// The rating of a part of a flight.
struct FlightRating {
  uint64_t fromUs = 0;
  uint64_t toUs = 0;
  double lost = 0;  // the share of lost, damaged or missing frames, 0 to 1
  bool failsafe = false;
  bool silent = false;
  bool late = false;  // the PC was late

  // Returns the worst of these; LostFrame if none is set.
  FlagSpan::Kind kind() const {
    return failsafe ? FlagSpan::Kind::Failsafe
           : silent ? FlagSpan::Kind::NoFrames
           : late   ? FlagSpan::Kind::Late
                    : FlagSpan::Kind::LostFrame;
  }
};

// Returns the flight in `count` parts of equal length, at most one per second.
std::vector<FlightRating> stripOf(const FlightLog &flight, size_t count);

// Returns the worst seconds, worst first, only those with losses, without those of the `count` longest spans of each
// kind.
std::vector<FlightRating> worstSeconds(const FlightLog &flight, size_t count);

// Rates the flight in one sentence.
struct FlightVerdict {
  enum class Severity { Good, Warning, Bad };

  Severity severity;
  std::string text;
};
// Without times it tells no lengths.
FlightVerdict verdictOf(const FlightLog &flight, bool hasTimes = true);

}  // namespace line
