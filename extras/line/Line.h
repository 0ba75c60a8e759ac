// A line: characters with their times, from a receiver, a recording or a simulation.
#pragma once

#include <cstdint>
#include <string>

#include "line/LineSettings.h"
#include "sbus/Frame.h"

namespace line {

constexpr uint32_t CharacterUs = sbus::CharacterTime;  // at 100000 baud; otherwise LineSettings::characterUs()

struct Character {
  uint64_t endUs = 0;  // the end of its last bit, in microseconds since the program's start
  uint8_t value = 0;
  bool bad = false;          // wrong parity or stop bit
  uint32_t lateUs = 0;       // a port held it back: it may have ended up to this much earlier
  bool parityWrong = false;  // the kind of error; both are false if the source does not tell
  bool stopWrong = false;
  uint64_t sinceUs = 0;  // in real time: it has waited since then at most, by clockUs(); 0: it has no age
};

// A line stays silent for this long after its end, so that the last frame can still be shown.
constexpr uint64_t TailUs = 300000;

class Line {
 public:
  virtual ~Line() = default;

  // Tells the line that the sketch opened the port for the first time, at `nowUs`.
  virtual void opened(uint64_t /*nowUs*/) {}

  // Takes the oldest character that was complete by `nowUs`. Returns false without one.
  virtual bool next(uint64_t nowUs, Character &character) = 0;

  // Returns the time up to which next() has returned all complete characters.
  virtual uint64_t knownUs(uint64_t nowUs) const { return nowUs; }

  // Waits for at most 50 ms until next() may return more. Returns false without waiting if the line cannot tell.
  virtual bool wait() { return false; }

  // Returns true if all characters up to `us` are there, or the line has ended. For a reader that sets the time itself.
  virtual bool canAdvanceTo(uint64_t /*us*/) { return true; }

  // Returns true if the line has ended.
  virtual bool finished(uint64_t /*nowUs*/) const { return false; }

  // Returns true if it has ended, but not as it should: the program that writes it is gone. For a finished line.
  virtual bool isBroken() const { return false; }

  // Returns why the line failed; otherwise empty.
  virtual std::string failure() const { return {}; }

  // Returns news about the port since the last call: it is gone, or back. Usually empty.
  virtual std::string news() { return {}; }

  // Tells the line that a board's TX, opened with these settings, shares the wire. Most lines ignore it.
  virtual void share(const LineSettings & /*tx*/) {}

  // Tells the line that this board has begun to send a character.
  virtual void hear(const Character & /*character*/) {}

  // Returns how the board behaved on a shared wire; usually empty.
  virtual std::string report() const { return {}; }

  // Returns a note that explains why the times are not exact, and what to do; usually empty.
  virtual std::string note() const { return {}; }
};

// A silent wire: the receiver has no power, or the wire is broken.
class SilentLine : public Line {
 public:
  bool next(uint64_t, Character &) override { return false; }
};

}  // namespace line
