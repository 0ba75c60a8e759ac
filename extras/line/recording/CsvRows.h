// The rows of numbers that a sketch prints for serial plotters: 1048,992,172,992,0,1 or 1048 992 or
// throttle:172,roll:992, with commas, semicolons, tabs or blanks. A row ends with \n, \r\n, or \r as in the paper.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "line/Line.h"
#include "line/LineSettings.h"

namespace line {

struct CsvField {
  std::string text;  // the number as printed
  std::string name;  // from "name:number"; otherwise empty
  double value = 0;
  bool isNumber = false;
};

using CsvRow = std::vector<CsvField>;

enum class CsvKind { Channel, Failsafe, LostFrame, Switch17, Switch18 };

// Returns the settings of a sketch's Serial: 115200 baud, 8N1.
LineSettings csvSettings();

// Finds a sketch's rows among the bytes of a port; the bytes of S.Bus are not text.
class CsvRows {
 public:
  // Takes the next byte. Returns true if it completes a row, or a line with other words.
  bool put(uint8_t byte);

  // Takes the next character of a port; one with an error is not text.
  bool put(const Character &character) { return put(character.bad ? uint8_t{0} : character.value); }

  // Returns the fields of the newest line: at most 64, from its first 1024 bytes.
  const CsvRow &row() const { return _row; }

  // Returns what a column of the newest row holds, from its name or from a line of names before the rows. Without
  // names, the last two of 6 columns are flags, as in examples/DecodeSBus, and the last two of 18 are switches, as in
  // examples/AllChannels, as long as they hold only 0 and 1.
  CsvKind kind(size_t column) const;

  // Returns how many bytes so far were not text: many if the baud rate is wrong.
  unsigned garbled() const { return _garbled; }

  // Returns true if the newest line has a comma or a name, which no line of a recording has.
  bool isTable() const { return _isTable; }

  // Returns true if the newest line is a sketch's row: one or more fields, all numbers.
  bool isRow() const { return _isRow; }

  // Returns true if the newest line is text: 4 or more characters, and no other bytes.
  bool isText() const { return _isText; }

  // Returns true once the text is a sketch's: two consecutive rows with the same number of columns, 2 or more. Returns
  // false again after bytes that are not text.
  bool recognised() const { return _recognised; }

 private:
  void endLine();
  void split();

  std::string _line;
  bool _returned = false;  // the newest byte was a \r that ended its line
  bool _text = true;       // this line is only text so far
  CsvRow _row;
  CsvRow _names;  // the line before the rows
  unsigned _garbled = 0;
  bool _isTable = false;
  bool _hasFlags = true;  // the last two columns were 0 or 1
  bool _isText = false;
  bool _isRow = false;
  size_t _columns = 0;  // of the previous row
  bool _recognised = false;
};

}  // namespace line
