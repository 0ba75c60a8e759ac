// What a flight was like: its frames, when it had failsafe, losses and silences, its worst seconds, its curves. Its
// size does not grow with the number of frames.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "line/Observer.h"
#include "line/report/Curves.h"
#include "line/report/FlagSpans.h"
#include "line/report/VariantOfLine.h"

namespace line {

// A second of the flight.
struct FlightSecond {
  unsigned frames = 0;
  unsigned lost = 0;      // of these, with the lost-frame flag
  unsigned failsafe = 0;  // of these, in failsafe
};

class FlightLog {
 public:
  explicit FlightLog(uint32_t characterUs);
  FlightLog(const FlightLog &) = delete;  // its observer's listener points to it
  FlightLog &operator=(const FlightLog &) = delete;

  void put(const Character &character) { _observer.put(character); }
  void idleUntil(uint64_t us) { _observer.idleUntil(us); }
  void finish();

  bool any() const { return _observer.counters().frames > 0; }
  const Observer &observer() const { return _observer; }
  std::string variant() const { return _variant.text(); }
  uint64_t firstUs() const { return _flags.firstUs(); }
  uint64_t lastUs() const { return _flags.lastUs(); }

  // Returns the spans of a kind in their order.
  std::vector<FlagSpan> spans(FlagSpan::Kind kind) const;

  // Returns how many frames ended this many milliseconds, rounded, after the frame before.
  const std::map<uint64_t, unsigned long> &intervals() const { return _intervals; }

  // Returns the seconds, by their number, in which frames came.
  const std::map<uint64_t, FlightSecond> &seconds() const { return _seconds; }

  // Returns how many frames did not come between two that were less than 0.1 s apart.
  unsigned long missing() const;

  // Returns how many frames a second should have; 0 if that is not known.
  double framesPerSecond() const;

  const Curves &curves() const { return _curves; }

 private:
  void take(const Stretch &stretch);

  Observer _observer;
  VariantOfLine _variant;
  FlagSpans _flags;
  std::map<uint64_t, unsigned long> _intervals;
  std::map<uint64_t, FlightSecond> _seconds;
  Curves _curves;
};

// A part of a flight, and how bad it was.
struct Badness {
  uint64_t fromUs;
  uint64_t toUs;
  double lost;  // the part of the frames that were lost, damaged or missing, 0 to 1
  bool failsafe;
  bool silent;
  bool late;  // the PC was

  // Returns the worst of these; of a part that has none of them, only frames were lost.
  FlagSpan::Kind kind() const {
    return failsafe ? FlagSpan::Kind::Failsafe
           : silent ? FlagSpan::Kind::NoFrames
           : late   ? FlagSpan::Kind::Late
                    : FlagSpan::Kind::LostFrame;
  }
};

// Returns the flight in `count` parts of equal length, at most one a second.
std::vector<Badness> stripOf(const FlightLog &flight, size_t count);

// Returns the worst seconds, the worst first; none in which nothing was lost.
std::vector<Badness> worstSeconds(const FlightLog &flight, size_t count);

// Says in one sentence how the flight was.
struct FlightVerdict {
  enum class Severity { Good, Warning, Bad };

  Severity severity;
  std::string text;
};
FlightVerdict verdictOf(const FlightLog &flight);

}  // namespace line
