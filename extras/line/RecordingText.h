// The text of a recording (see Recording.h), as it is written.
#pragma once

#include <cstdint>
#include <string>

#include "Line.h"
#include "LineSettings.h"

namespace line {

// Each call appends to `text`.
class RecordingText {
 public:
  // The line is set so from now on: a comment says so.
  void opened(const LineSettings &settings, std::string &text);

  void put(const Character &character, std::string &text);

  // Ends the last line. Called once, at the end.
  void finish(std::string &text) { endLine(text); }

 private:
  void endLine(std::string &text);

  bool _opened = false;
  LineSettings _settings;
  uint64_t _lastEndUs = 0;
  unsigned _onLine = 0;  // characters of the line that is not yet complete
};

}  // namespace line
