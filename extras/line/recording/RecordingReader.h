// Reads recordings and a sketch's rows line by line.
#pragma once

#include <string>
#include <string_view>

#include "line/file/LineReader.h"
#include "line/recording/LateReads.h"
#include "line/recording/Recording.h"

namespace line {

// NULs end a line: what precedes them is read, up to its last whole byte. A file system leaves them where the power
// failed.
class RecordingReader : public LineReader {
 public:
  // `characterUs` is the time of a character on the line. `isWhole`: nobody writes it any more, and LateReads may hold
  // characters back.
  explicit RecordingReader(uint32_t characterUs = CharacterUs, bool isWhole = false)
      : _characterUs(characterUs), _isWhole(isWhole) {}

  std::string line(std::string_view text, std::deque<Character> &characters) override;
  std::string finish(std::deque<Character> &characters) override;
  std::string news() override;

 private:
  std::string take(std::string_view text, std::deque<Character> &characters);

  const uint32_t _characterUs;
  const bool _isWhole;
  LateReads _lateReads;
  uint64_t _lastUs = 0;  // the newest character's end
  bool _any = false;
  bool _isFirst = true;  // the next line is
  bool _hasEnded = false;
  unsigned long _nuls = 0;
};

// The rows come every 200 ms, as the examples print them, or at the times in their first column, if its name is "time"
// or "seconds", as sbus csv and the scope write them.
class RowsReader : public LineReader {
 public:
  explicit RowsReader(uint32_t characterUs) : _characterUs(characterUs) {}

  std::string line(std::string_view text, std::deque<Character> &characters) override;
  // Like a port, leaves out a row without its end.
  std::string cutLine(std::string_view /*text*/, std::deque<Character> & /*characters*/) override { return {}; }
  std::string finish(std::deque<Character> &characters) override;

 private:
  const uint32_t _characterUs;
  uint64_t _lastUs = 0;  // the newest character's end
  bool _any = false;
  bool _hasTimes = false;
};

// Reads the whole text of a recording. With an error, the characters are those before it.
Recording parseRecording(std::string_view text, uint32_t characterUs = CharacterUs);

}  // namespace line
