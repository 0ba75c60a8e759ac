// Writes the text of a recording (see Recording.h).
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "line/Line.h"
#include "line/LineSettings.h"

namespace line {

class RecordingWriter {
 public:
  // Writes a comment of one line.
  void comment(const std::string &text);

  // Writes a comment that says when time 0 was, in us since 1970, and the version of the format.
  void began(int64_t us);

  // Writes a comment with the line's settings from now on.
  void opened(const LineSettings &settings);

  // Writes the next character. One that ends too early for its line gets the earliest time that a reader takes.
  void put(const Character &character);

  // Ends the last line: at the end, or because the line is silent.
  void finish() { endLine(); }

  // Returns the whole lines since the last call: less than 25 characters wait for their line's end.
  std::string take() { return std::exchange(_done, {}); }

 private:
  void endLine();

  std::string _done;
  std::string _line;  // not yet complete
  bool _opened = false;
  LineSettings _settings;
  bool _begun = false;  // a character has come
  uint64_t _lastEndUs = 0;
  uint32_t _lateUs = 0;  // of the characters of _line
  unsigned _onLine = 0;  // characters of _line
};

}  // namespace line
