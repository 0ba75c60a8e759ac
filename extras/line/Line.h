// What can be at the other end of the wire.
#pragma once

#include <cstdint>
#include <string>

#include "line/simulation/LineSettings.h"
#include "sbus/Frame.h"

namespace line {

constexpr uint32_t CharacterUs = sbus::CharacterTime;  // unless the wire is a fast one, see LineSettings

struct Character {
  uint64_t endUs = 0;  // when its last bit was through, in microseconds since the program's start
  uint8_t value = 0;
  bool bad = false;          // its parity or a stop bit was wrong
  uint32_t lateUs = 0;       // a port kept it back: it ended this much earlier at most
  bool parityWrong = false;  // of a bad one, what was wrong; neither, if its source does not tell
  bool stopWrong = false;
};

class Line {
 public:
  virtual ~Line() = default;

  // The sketch has opened the port, for the first time, at `nowUs`.
  virtual void opened(uint64_t /*nowUs*/) {}

  // Takes the oldest character that was through by `nowUs`; returns false without one.
  virtual bool next(uint64_t nowUs, Character &character) = 0;

  // Returns the time up to which next() has brought all that was through.
  virtual uint64_t knownUs(uint64_t nowUs) const { return nowUs; }

  // Waits until next() may bring more, for 50 ms at most. Returns false without waiting if the line cannot tell.
  virtual bool wait() { return false; }

  // True if nothing more will ever come.
  virtual bool finished(uint64_t /*nowUs*/) const { return false; }

  // Why the line broke down; empty if it did not.
  virtual std::string failure() const { return {}; }

  // Returns what has happened to the port since the last call: it has gone, or is back. Mostly nothing.
  virtual std::string news() { return {}; }

  // A board's TX shares the wire, and was opened with these settings. Most lines have a wire of their own.
  virtual void share(const LineSettings & /*tx*/) {}

  // That board has begun to send this character.
  virtual void hear(const Character & /*character*/) {}

  // Returns how the board has behaved on a wire that it shares; mostly nothing.
  virtual std::string report() const { return {}; }

  // Returns what keeps its times from being exact, a line with what to do; mostly nothing.
  virtual std::string note() const { return {}; }
};

}  // namespace line
