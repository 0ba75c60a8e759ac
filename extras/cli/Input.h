// A line that a subcommand reads in real time or as fast as it can.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "line/Line.h"
#include "line/LineSettings.h"

namespace tool {

class Input {
 public:
  // Live counts the time for which the PC sleeps; RealTime, for a file or a simulation, pauses meanwhile.
  enum class Pace { Live, RealTime, AtOnce };

  // Reads for `seconds`; 0: until the line ends.
  Input(std::unique_ptr<line::Line> line, const line::LineSettings &settings, Pace pace, double seconds)
      : _line(std::move(line)), _settings(settings), _pace(pace), _seconds(seconds) {}

  const line::LineSettings &settings() const { return _settings; }

  // Sets the function that takes the news that a port is gone, or back. Default: print it to standard error.
  void onNews(std::function<void(const std::string &)> tell) { _tell = std::move(tell); }

  // Makes run() and runBoth() return when the line fails, as if it ended. Default: they throw std::runtime_error.
  void endOnFailure() { _endsOnFailure = true; }
  std::string failure() const { return _line->failure(); }

  // Throws std::runtime_error if the line has failed. Call it after run(), once everything before the failure is out.
  void requireWhole() const;

  // Sets the time at which run() begins; earlier characters are left out. Default: 0.
  void setStart(uint64_t us) { _startUs = us; }

  // Calls `put` with each character as it arrives, and `tick` every millisecond; on a port, whenever bytes arrive and
  // 20 times a second. Returns when the line has ended, after Ctrl-C, after the seconds, or after end(). Throws
  // std::runtime_error if the line fails.
  void run(const std::function<void(const line::Character &)> &put, const std::function<void(uint64_t nowUs)> &tick);

  // Returns the time of the tick; within `put`, of the next tick.
  uint64_t nowUs() const { return _nowUs; }

  // Returns the time up to which all characters are known, for use in a tick: earlier than the tick's own time if the
  // port delivers bytes late.
  uint64_t knownUs() const { return _knownUs; }

  // Returns true if the line has brought its last character, for use in a tick: what follows is no silence of the line.
  bool hasEnded() const { return !failure().empty() || _line->finished(_nowUs + line::TailUs); }

  // Returns true if run() has returned because the line has ended, but not as it should.
  bool isBroken() const { return hasEnded() && _line->isBroken(); }

  // Returns when --seconds end a real-time source; UINT64_MAX without --seconds.
  uint64_t limitUs() const {
    return _pace != Pace::AtOnce && _seconds > 0 ? static_cast<uint64_t>(_seconds * 1e6) : UINT64_MAX;
  }

  // Returns --seconds; 0 without it.
  double seconds() const { return _seconds; }

  std::string note() const { return _line->note(); }

  // Throws std::runtime_error if the line fails right at its beginning.
  void check();

  // Makes run() return after the current tick.
  void end() { _ended = true; }

  // Makes the next tick of a real-time source come after 0.25 ms, once: for work that is due before the next byte.
  void hurry() { _hurries = true; }

  // Takes the characters and ticks of one of two inputs.
  struct Taker {
    std::function<void(const line::Character &)> put;
    std::function<void(uint64_t nowUs)> tick;
  };

  // Runs two inputs together, from the same moment on, until both have ended; it polls them every 0.25 ms. One that
  // runs as fast as it can stays in step with the other: their times differ by at most a tick, once `aheadUs` is added
  // to those of `one`. Throws std::runtime_error if a line fails that does not endOnFailure(); otherwise reports it.
  static void runBoth(Input &one, const Taker &takeOne, Input &other, const Taker &takeOther, int64_t aheadUs = 0);

 private:
  void begin();
  bool step(const Taker &taker);
  uint64_t dueForUs(uint64_t endUs) const;
  bool advance();
  bool isOverdue() const;
  uint64_t clockUs() const;
  uint64_t sinceUs() const { return clockUs() - _startedUs; }
  void wait();

  std::unique_ptr<line::Line> _line;
  line::LineSettings _settings;
  Pace _pace;
  double _seconds;
  uint64_t _startUs = 0;
  bool _ended = false;
  bool _hurries = false;
  bool _endsOnFailure = false;
  uint64_t _startedUs = 0;  // by clockUs()
  uint64_t _nowUs = 0;
  uint64_t _endUs = UINT64_MAX;
  uint64_t _knownUs = 0;
  std::function<void(const std::string &)> _tell;
};

}  // namespace tool
