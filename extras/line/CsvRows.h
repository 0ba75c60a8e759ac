// The rows of numbers that a sketch prints: 1048,992,172,992,0,1
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "Line.h"
#include "LineSettings.h"

namespace line {

struct CsvField {
  std::string text;  // as it was printed
  double value = 0;
  bool isNumber = false;
};

using CsvRow = std::vector<CsvField>;

// What such a column is most likely called: "CH1" to "CH4", "failsafe", "lostFrame" of 6 columns, as
// examples/DecodeSBus prints them; else "CH1" and so on.
std::string csvName(size_t column, size_t columns);

// How a sketch's Serial is set: 115200 baud, 8N1.
LineSettings csvSettings();

// Takes the bytes of a text, and tells a sketch's rows from the bytes of S.Bus, which are no text.
class CsvRows {
 public:
  // The next byte. True if it has completed a row, or a line of other words.
  bool put(uint8_t byte);

  // The same of what a port has received; a bad character is no text.
  bool put(const Character &character) { return put(character.bad ? uint8_t{0} : character.value); }

  // The newest line's fields; further ones than 64 are left out, and so is what follows 1024 bytes of a line.
  const CsvRow &row() const { return _row; }

  // The newest line is one of a sketch's rows: 1 or more fields, each a number.
  bool isRow() const { return _isRow; }

  // The newest line is text: 4 characters or more, and no other bytes.
  bool isText() const { return _isText; }

  // True once the text is a sketch's: two rows in a row, of 2 or more columns, and as many in both. False again when
  // something comes that is no text.
  bool recognised() const { return _recognised; }

 private:
  void endLine();

  std::string _line;
  bool _text = true;  // nothing else has come on this line
  CsvRow _row;
  bool _isText = false;
  bool _isRow = false;
  size_t _columns = 0;  // of the row before
  bool _recognised = false;
};

}  // namespace line
