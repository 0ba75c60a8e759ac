// Turns a file's text into characters.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "line/FrameBytes.h"
#include "line/Line.h"

namespace line {

constexpr size_t FileHeadMax = 65536;  // bytes; they must show what a file is

class LineReader {
 public:
  virtual ~LineReader() = default;

  // Takes the next line, without its LF, and appends its characters. Returns what is wrong with it, or nothing.
  virtual std::string line(std::string_view text, std::deque<Character> &characters) = 0;

  // Takes the last line, if it has no LF: the text may be cut within it. Returns the same.
  virtual std::string cutLine(std::string_view text, std::deque<Character> &characters) {
    return line(text, characters);
  }

  // Takes the end of the text, and appends the last characters. Returns what is missing, or nothing.
  virtual std::string finish(std::deque<Character> &characters) = 0;

  // Returns what was changed in a line that was read, once; usually empty.
  virtual std::string news() { return {}; }

  // Returns true if the text itself has said that this is its end.
  virtual bool isComplete() const { return false; }

  // Returns true if it takes a file's bytes as they are, in pieces, instead of lines of text.
  virtual bool takesBytes() const { return false; }

  // Returns the text's time at which the characters' times begin, in us: below 0 if the text begins before its own time
  // 0, a trigger's. Known with the first character.
  int64_t zeroUs() const { return _zeroUs; }

 protected:
  // Takes the beginning of the first character.
  void begin(int64_t us) { _zeroUs = us < 0 ? us : 0; }

 private:
  int64_t _zeroUs = 0;
};

// The common part of readers whose lines are frames with their times.
class FrameReader : public LineReader {
 public:
  std::string news() override { return std::exchange(_news, {}); }

 protected:
  static constexpr uint64_t PeriodUs = 9000;  // of frames without times: the paper's receiver

  explicit FrameReader(uint32_t characterUs) : _characterUs(characterUs) {}

  // Returns when characters end that end at `us` in the text; without a time, a period after those before. The first
  // ones last for `lengthUs` at most.
  uint64_t endOf(std::optional<int64_t> us, uint64_t lengthUs) {
    if (!_any && us) {
      begin(*us - static_cast<int64_t>(lengthUs));
    }
    return us ? static_cast<uint64_t>(std::max<int64_t>(0, *us - zeroUs())) : _lastUs + PeriodUs;
  }

  // Takes characters that end at `lastUs`, though they should end at `endUs`. News tell once that they are moved.
  void placed(uint64_t endUs, uint64_t lastUs) {
    if (std::exchange(_any, true) && lastUs > endUs && !std::exchange(_isTold, true)) {
      _news = "its time, " + std::to_string(endUs) + " us, overlaps what comes before it: moved by " +
              std::to_string(lastUs - endUs) + " us, and others may be";
    }
    _lastUs = lastUs;
  }

  // Appends characters that end at `us` in the text, back to back; without a time, a period after those before. A port
  // may have held them back for `lateUs`. Returns what is wrong with the time, or nothing.
  std::string put(std::optional<int64_t> us, uint32_t lateUs, const std::vector<Character> &came,
                  std::deque<Character> &characters) {
    constexpr uint64_t OverlapMostUs = 10000000;  // more than this is another line's time
    const uint64_t endUs = endOf(us, came.size() * _characterUs);
    if (_any && endUs + OverlapMostUs < _lastUs) {
      return "its time, " + std::to_string(endUs) + " us, is not after the previous one, " + std::to_string(_lastUs) +
             " us";
    }
    placed(endUs, appendLate(came, endUs, _lastUs, _characterUs, lateUs, characters));
    return {};
  }

  const uint32_t _characterUs;
  uint64_t _lastUs = 0;
  bool _any = false;

 private:
  bool _isTold = false;
  std::string _news;
};

}  // namespace line
