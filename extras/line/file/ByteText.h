// Reads bytes as people write them: hexadecimal, decimal, octal or binary numbers, dumps of xxd, hexdump and od, strings
// of Python and C, lists and arrays of any language, with labels, prompts and a log's prefixes before them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "line/file/ByteWords.h"

namespace line {

class ByteText {
 public:
  // Finds out from a text's first lines how it is written. `isWhole`: they are all of it.
  ByteText(std::string_view head, bool isWhole);

  // Returns true if the first lines hold bytes. A sketch's rows and a recording may look like bytes, too; then isList(),
  // hasOffsets() and hasFrames() decide.
  bool isBytes() const { return _lines > 0; }

  // Returns true if lines begin with offsets.
  bool hasOffsets() const { return _offsetBase != 0; }

  // Returns true if only bytes are written like this: within brackets, with 0x, or as a string.
  bool isList() const { return _isList; }

  // Returns true if a line begins with a frame.
  bool hasFrames() const { return _frameLines > 0; }

  // Returns true if most lines are a frame and something else behind it: then the end of a line is a silence.
  bool hasFilledLines() const { return _filledLines > 0 && 2 * _frameLines > _lines && !hasOffsets(); }

  // Returns 2, 8, 10 or 16.
  int base() const { return _base; }

  // Reads the next line. Appends its bytes; in a dump those of the line before, since an offset says how many they are.
  // Returns what is wrong with it and what is expected, or nothing; a line may hold no bytes.
  std::string line(std::string_view text, TextBytes &bytes);

  // Appends the last line's bytes.
  void finish(TextBytes &bytes);

 private:
  // How a line's bytes are written.
  enum class Form { Numbers, Strings, Cells };

  struct Style;

  void findOffsets(std::string_view head);
  void findStyle(std::string_view head);
  void findOrder(std::string_view line);
  bool takeOffset(std::string_view &text, uint64_t &offset) const;
  std::string_view numbersOf(std::string_view line) const;
  std::string read(std::string_view line, TextBytes &bytes) const;
  bool readNumber(std::string_view word, bool isNegative, TextBytes &bytes) const;
  std::string repeat(uint64_t offset, TextBytes &bytes);

  Form _form = Form::Numbers;
  bool _isList = false;
  bool _isBare = true;  // lines have numbers only
  int _base = 16;
  int _offsetBase = 0;      // 0: there are no offsets
  size_t _perLine = 0;      // bytes, if there are offsets
  size_t _endColumn = 0;    // where a whole line's bytes end, counted from its offset on
  bool _isSwapped = false;  // a word's lowest byte comes first in the file, and last in the text
  size_t _lines = 0;        // of the head, with bytes
  size_t _frameLines = 0;   // that begin with a frame
  size_t _filledLines = 0;  // that continue after it, or end before its tail

  TextBytes _held;          // the newest line's, if there are offsets
  uint64_t _at = 0;         // the offset after them
  bool _hasOffset = false;  // there was one
  bool _repeats = false;    // a * came
};

// Returns the size of the frame at the beginning of the bytes; 0 without one.
size_t frameAt(const TextBytes &bytes);

}  // namespace line
