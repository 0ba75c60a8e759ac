// A line that a verb reads, in true time or as fast as it goes.
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
  enum class Pace { True, AtOnce };

  // `seconds`: how long it is read; 0: until it ends.
  Input(std::unique_ptr<line::Line> line, const line::LineSettings &settings, Pace pace, double seconds)
      : _line(std::move(line)), _settings(settings), _pace(pace), _seconds(seconds) {}

  // How the port is set.
  const line::LineSettings &settings() const { return _settings; }

  // What is said of a port that has gone, or is back: on standard error unless told.
  void onNews(std::function<void(const std::string &)> tell) { _tell = std::move(tell); }

  // So many times as fast as true time.
  void setSpeed(double speed) { _speed = speed; }

  // Hands over each character as it comes, and every millisecond says the time, up to which all have come. Both begin
  // at 0. Returns when the line has ended, after Ctrl-C, after the seconds, or after end(). Throws std::runtime_error
  // if the line breaks down.
  void run(const std::function<void(const line::Character &)> &put, const std::function<void(uint64_t nowUs)> &tick);

  // run() returns after the present tick: a key was pressed.
  void end() { _ended = true; }

 private:
  std::unique_ptr<line::Line> _line;
  line::LineSettings _settings;
  Pace _pace;
  double _seconds;
  double _speed = 1;
  bool _ended = false;
  std::function<void(const std::string &)> _tell;
};

}  // namespace tool
