// Writes a recording (see Recording.h).
#pragma once

#include <cstdint>
#include <ostream>

#include "Line.h"
#include "LineSettings.h"

namespace line {

class RecordingWriter {
 public:
  // `out` must outlive it. Whoever owns it looks whether it has gone wrong.
  explicit RecordingWriter(std::ostream &out) : _out(out) {}

  // The line is set so from now on: a comment says so.
  void opened(const LineSettings &settings);

  void put(const Character &character);

  // Ends the last line. Called once, at the end.
  void finish() { endLine(); }

 private:
  void endLine();

  std::ostream &_out;
  bool _opened = false;
  LineSettings _settings;
  uint64_t _lastEndUs = 0;
  unsigned _onLine = 0;  // characters of the line that is not yet complete
};

}  // namespace line
