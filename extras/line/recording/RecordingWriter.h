// Writes the text of a recording (see Recording.h).
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "line/Line.h"
#include "line/simulation/LineSettings.h"

namespace line {

class RecordingWriter {
 public:
  // A comment, one line of it.
  void comment(const std::string &text);

  // The line is set so from now on: a comment says so.
  void opened(const LineSettings &settings);

  // The next character. One that ends too early for the line that it is on gets the earliest time that a reader takes.
  void put(const Character &character);

  // Ends the last line. Called once, at the end.
  void finish() { endLine(); }

  // The whole lines since the last call: at most 25 characters wait for their line's end.
  std::string take() { return std::exchange(_done, {}); }

 private:
  void endLine();

  std::string _done;
  std::string _line;  // not yet complete
  bool _opened = false;
  LineSettings _settings;
  bool _begun = false;  // a character has come
  uint64_t _lastEndUs = 0;
  uint32_t _lateUs = 0;  // of its characters
  unsigned _onLine = 0;  // characters of it
};

}  // namespace line
