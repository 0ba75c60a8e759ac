// A line: characters with their times, from a receiver, a recording or a simulation.
#pragma once

#include <cstdint>
#include <string>

#include "line/LineSettings.h"
#include "sbus/Frame.h"

namespace line {

constexpr uint32_t CharacterUs = sbus::CharacterTime;  // at 100000 baud; see LineSettings

struct Character {
  uint64_t endUs = 0;  // when its last bit was complete, in microseconds since the program's start
  uint8_t value = 0;
  bool bad = false;          // its parity or a stop bit was wrong
  uint32_t lateUs = 0;       // a port held it back: it ended at most this much earlier
  bool parityWrong = false;  // which error it has; both are false if its source does not tell
  bool stopWrong = false;
};

// For how long a line that has ended goes on being silent, so that what it brought last can still be shown.
constexpr uint64_t TailUs = 300000;

class Line {
 public:
  virtual ~Line() = default;

  // Tells the line that the sketch has opened the port for the first time, at `nowUs`.
  virtual void opened(uint64_t /*nowUs*/) {}

  // Takes the oldest character that was complete by `nowUs`; returns false without one.
  virtual bool next(uint64_t nowUs, Character &character) = 0;

  // Returns the time up to which next() has brought all complete characters.
  virtual uint64_t knownUs(uint64_t nowUs) const { return nowUs; }

  // Waits until next() may bring more, for 50 ms at most. Returns false without waiting if the line cannot tell.
  virtual bool wait() { return false; }

  // Returns true if all characters up to `us` have come, or nothing more will. For a reader that sets the time itself.
  virtual bool mayGoTo(uint64_t /*us*/) { return true; }

  // Returns true if nothing more will ever come.
  virtual bool finished(uint64_t /*nowUs*/) const { return false; }

  // Returns why the line failed; empty if it did not.
  virtual std::string failure() const { return {}; }

  // Returns what has happened to the port since the last call: it has gone, or is back. Mostly empty.
  virtual std::string news() { return {}; }

  // Tells the line that a board's TX shares the wire, and was opened with these settings. Most lines ignore it.
  virtual void share(const LineSettings & /*tx*/) {}

  // Tells the line that this board has begun to send this character.
  virtual void hear(const Character & /*character*/) {}

  // Returns how the board has behaved on a wire that it shares; mostly empty.
  virtual std::string report() const { return {}; }

  // Returns a line that says why its times are not exact, and what to do; mostly empty.
  virtual std::string note() const { return {}; }
};

}  // namespace line
