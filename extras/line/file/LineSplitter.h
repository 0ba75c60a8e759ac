// Splits a text that arrives in pieces into lines, in bounded memory.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

namespace line {

// Characters of a line: enough for twenty minutes of S.Bus as one list of numbers, and little for a PC or a browser.
constexpr size_t TextLineMax = size_t{1} << 24;

class LineSplitter {
 public:
  // Takes the next piece; an empty one is the end of the text.
  void put(std::string_view piece) {
    _atEnd = piece.empty();
    _looked -= std::min(_looked, _at);
    _text.erase(0, std::exchange(_at, 0));
    _text += piece;
  }

  // Takes the next whole line, without its LF; the last line may lack one. Returns false if there is no line yet.
  bool take(std::string &line) {
    const size_t end = std::min(_text.find('\n', std::max(_at, _looked)), _text.size());
    _isCut = end == _text.size();
    _isTooLong = end - _at > TextLineMax;
    if (_isCut && !_isTooLong && (!_atEnd || _at == end)) {
      _looked = end;
      return false;
    }
    line.assign(_text, _at, end - _at);
    _at = end + (_isCut ? 0 : 1);
    _number++;
    return true;
  }

  // Takes all that was put in.
  std::string takeAll() { return std::exchange(_text, {}).substr(std::exchange(_at, 0)); }

  // Returns true if the last line taken had no LF.
  bool isCut() const { return _isCut; }

  // Returns why the last line taken is none, though its text may be good; usually empty.
  std::string wrong() const {
    return _isTooLong ? "the line is longer than " + std::to_string(TextLineMax) + " characters: line ends are expected"
                      : "";
  }

  // Returns the number of the last line taken, counted from 1.
  unsigned long number() const { return _number; }

  bool atEnd() const { return _atEnd; }

 private:
  std::string _text;
  size_t _at = 0;      // the first character not yet taken
  size_t _looked = 0;  // none before has a line end
  unsigned long _number = 0;
  bool _isCut = false;
  bool _isTooLong = false;
  bool _atEnd = false;
};

}  // namespace line
