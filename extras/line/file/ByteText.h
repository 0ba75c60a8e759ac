// Reads bytes as people write them: hexadecimal or decimal numbers, strings of Python and C, lists and arrays of any
// language, dumps of xxd, hexdump and od -t x1, with labels, prompts and a log's prefixes before them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "line/file/TextNumbers.h"

namespace line {

class ByteText {
 public:
  // Finds out from a text's first lines how it is written. `isWhole`: they are all of it. Words around lines of bytes
  // are left out: people post them, and terminals write them.
  ByteText(std::string_view head, bool isWhole);

  // Rejects lines with words, if the first one with bytes has numbers only.
  void setStrict() { _isStrict = true; }

  // Returns true if the first lines hold bytes. A sketch's rows and a recording may look like bytes, too; then
  // isList(), hasOffsets() and BytesReader decide.
  bool isBytes() const { return _lines > 0; }

  // Returns true if lines begin with offsets, as a dump's do.
  bool hasOffsets() const { return _offsetBase != 0; }

  // Returns true if only bytes are written like this: within brackets, with 0x, or as a string.
  bool isList() const { return _isList; }

  // Returns true for a dump of words of two bytes or more.
  bool hasWords() const { return _hasWords; }

  // Takes a dump's words for bytes in the other order: xxd -e prints them as a PC reads them.
  void swapWords() { _areSwapped = !_areSwapped; }

  bool isDecimal() const { return _base == 10 && !_hasStrings; }

  // Appends the bytes of a line. Returns what is wrong with it and what is expected, or nothing; a line may hold no
  // bytes.
  std::string line(std::string_view text, TextBytes &bytes) const;

 private:
  void findOffsets(std::string_view head);
  void findStyle(std::string_view head);
  bool takeOffset(std::string_view &text, uint64_t &offset) const;
  Numbers numbersOf(std::string_view line) const;
  bool isFrame(const Numbers &numbers) const;
  std::string read(const TextNumber &number, TextBytes &bytes) const;

  int _offsetBase = 0;       // 0: there are no offsets
  size_t _width = 0;         // of a dump's line up to the text beside the bytes
  bool _areSwapped = false;  // a word's lowest byte comes first in the file, and last in the text
  bool _hasWords = false;
  bool _hasMarks = false;  // 0x
  bool _hasStrings = false;
  bool _isList = false;
  bool _isBare = false;  // the first line with bytes has numbers only
  bool _isStrict = false;
  bool _hasIndex = false;  // a byte a line, after its number
  int _base = 16;
  size_t _lines = 0;  // of the head, with bytes
};

}  // namespace line
