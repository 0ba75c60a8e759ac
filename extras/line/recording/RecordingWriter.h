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
  // Writes a one-line comment.
  void comment(const std::string &text);

  // Writes a comment with the date of time 0, given in us since 1970, and the version of the format.
  void began(int64_t us);

  // Sets the time of the text at which the characters' times begin; see Recording::zeroUs. Default: 0.
  void setZero(int64_t us) { _zeroUs = us; }

  // Writes a comment with the line's settings from here on.
  void opened(const LineSettings &settings);

  // Writes the next character. If it ends too early for its line, it gets the earliest time that a reader accepts.
  void put(const Character &character);

  // Ends the last line of text, at the end or because the line is silent.
  void finish() { endLine(); }

  // Returns the whole lines since the last call: fewer than 25 characters wait for the end of their line.
  std::string take() { return std::exchange(_done, {}); }

 private:
  void endLine();

  std::string _done;
  std::string _line;  // incomplete
  bool _opened = false;
  LineSettings _settings;
  bool _begun = false;  // there was a character
  int64_t _zeroUs = 0;
  uint64_t _lastEndUs = 0;
  uint32_t _lateUs = 0;  // of the characters of _line
  unsigned _onLine = 0;  // characters of _line
};

}  // namespace line
