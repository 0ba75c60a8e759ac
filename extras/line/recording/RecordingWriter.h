// Writes the text of a recording (see Recording.h).
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

#include "line/Line.h"
#include "line/recording/WallTime.h"
#include "line/LineSettings.h"

namespace line {

class RecordingWriter {
 public:
  // Writes a one-line comment.
  void comment(const std::string &text) {
    endLine();
    _done += "# " + text + '\n';
  }

  // Writes a comment with the date of time 0, given in us since 1970, and the version of the format.
  void began(int64_t us) { comment(std::string(BeganText) + wallTime(us)); }

  // Sets the time of the text at which the characters' times begin; see Recording::zeroUs. Default: 0.
  void setZero(int64_t us) { _zeroUs = us; }

  // Writes a comment with the line's settings from here on.
  void opened(const LineSettings &settings) {
    if (_opened && settings == _settings) {
      return;
    }
    _opened = true;
    _settings = settings;
    comment(text(settings));
  }

  // Writes the next character. If it ends too early for its line, it gets the earliest time that a reader accepts.
  void put(const Character &character) {
    const uint64_t earliestUs = _begun ? _lastEndUs + _settings.characterUs() : 0;
    const uint64_t endUs = std::max(character.endUs, earliestUs);
    if (endUs != earliestUs || character.lateUs != _lateUs) {
      endLine();
    }
    if (_onLine == 0) {
      _line = std::to_string(static_cast<int64_t>(endUs) + _zeroUs) +
              (character.lateUs == 0 ? "" : "~" + std::to_string(character.lateUs));
      _lateUs = character.lateUs;
    }
    constexpr char Digits[] = "0123456789ABCDEF";
    _line += ' ';
    _line += Digits[character.value >> 4];
    _line += Digits[character.value & 0xF];
    _line += character.bad ? "!" : "";
    _lastEndUs = endUs;
    _begun = true;
    if (++_onLine == LineMax) {
      endLine();
    }
  }

  // Ends the last line of text, at the end or because the line is silent.
  void finish() { endLine(); }

  // Returns the whole lines since the last call: fewer than 25 characters wait for the end of their line.
  std::string take() { return std::exchange(_done, {}); }

 private:
  // Each frame gets its own line, even if the next one follows at once, and no line is too long for a reader.
  static constexpr unsigned LineMax = sbus::FrameSize;

  void endLine() {
    if (_onLine != 0) {
      _done += _line + '\n';
      _onLine = 0;
    }
  }

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
