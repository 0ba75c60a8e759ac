// Turns a file's text into characters.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "line/Line.h"
#include "line/recording/Recording.h"

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

  // Returns a recording's bookmarks, after its end; nullptr for other texts.
  virtual const std::vector<Bookmark> *bookmarks() const { return nullptr; }

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

// Tells once that lines of a text overlap.
class OverlapNews {
 public:
  // Takes the time of a frame in the text, and where it ends.
  void put(uint64_t us, uint64_t endUs) {
    if (endUs > us && !std::exchange(_isTold, true)) {
      _news = "its time, " + std::to_string(us) + " us, overlaps what comes before it: moved by " +
              std::to_string(endUs - us) + " us, and others may be";
    }
  }

  std::string take() { return std::exchange(_news, {}); }

 private:
  bool _isTold = false;
  std::string _news;
};

}  // namespace line
