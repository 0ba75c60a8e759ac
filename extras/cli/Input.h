// A line that a subcommand reads, in true time or as fast as it goes.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "line/Line.h"
#include "line/simulation/LineSettings.h"

namespace tool {

class Input {
 public:
  enum class Pace { True, AtOnce };

  // `seconds`: how long it is read; 0: until it ends.
  Input(std::unique_ptr<line::Line> line, const line::LineSettings &settings, Pace pace, double seconds)
      : _line(std::move(line)), _settings(settings), _pace(pace), _seconds(seconds) {}

  // How the port is set.
  const line::LineSettings &settings() const { return _settings; }

  // Where a port that has gone, or is back, is reported. Default: standard error.
  void onNews(std::function<void(const std::string &)> tell) { _tell = std::move(tell); }

  // The time that run() begins with: a line before that is not heard. Default: 0.
  void setStart(uint64_t us) { _startUs = us; }

  // The speed, as a multiple of true time.
  void setSpeed(double speed) { _speed = speed; }

  // Hands over each character as it comes, and says the time: every millisecond, of a port whenever it brings bytes and
  // 20 times a second. Returns when the line has ended, after Ctrl-C, after the seconds, or after
  // end(). Throws std::runtime_error if the line breaks down.
  void run(const std::function<void(const line::Character &)> &put, const std::function<void(uint64_t nowUs)> &tick);

  // In a tick: all that was through by then has been handed over. Earlier than its time, if the port is late.
  uint64_t knownUs() const { return _knownUs; }

  // Returns when --seconds ends what is done in true time; without them it is never.
  uint64_t limitUs() const {
    return _pace == Pace::True && _seconds > 0 ? static_cast<uint64_t>(_seconds * 1e6) : UINT64_MAX;
  }

  // As Line's.
  std::string note() const { return _line->note(); }

  // run() returns after the present tick: a key was pressed.
  void end() { _ended = true; }

 private:
  std::unique_ptr<line::Line> _line;
  line::LineSettings _settings;
  Pace _pace;
  double _seconds;
  double _speed = 1;
  uint64_t _startUs = 0;
  bool _ended = false;
  uint64_t _knownUs = 0;
  std::function<void(const std::string &)> _tell;
};

}  // namespace tool
