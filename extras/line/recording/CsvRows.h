// The rows of numbers that a sketch prints, as serial plotters take them: 1048,992,172,992,0,1 or 1048 992 or
// throttle:172,roll:992, with commas, tabs or blanks. A row ends with \n, \r\n, or \r as in the paper.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "line/Line.h"
#include "line/LineSettings.h"

namespace line {

struct CsvField {
  std::string text;  // the number as it was printed
  std::string name;  // of "name:number"; otherwise empty
  double value = 0;
  bool isNumber = false;
};

using CsvRow = std::vector<CsvField>;

// What a column holds.
enum class CsvKind { Channel, Failsafe, LostFrame, Switch17, Switch18 };

// Returns the settings of a sketch's Serial: 115200 baud, 8N1.
LineSettings csvSettings();

// Finds a sketch's rows among the bytes of a port; the bytes of S.Bus are no text.
class CsvRows {
 public:
  // Takes the next byte. Returns true if it has completed a row, or a line of other words.
  bool put(uint8_t byte);

  // Takes the next character of a port; one with an error is no text.
  bool put(const Character &character) { return put(character.bad ? uint8_t{0} : character.value); }

  // Returns the fields of the newest line: 64 at most, from its first 1024 bytes.
  const CsvRow &row() const { return _row; }

  // Returns what a column of the newest row holds, by its name or by a line of names before the rows. Without names the
  // last two of 6 are flags, as examples/DecodeSBus prints them, and the last two of 18 are switches, as
  // examples/AllChannels prints them, as long as only 0 and 1 have stood there.
  CsvKind kind(size_t column) const;

  // Returns how many bytes were no text, since the beginning: many if the baud rate is wrong.
  unsigned garbled() const { return _garbled; }

  // Returns true if the newest line has a comma or a name: no line of a recording has.
  bool isTable() const { return _isTable; }

  // Returns true if the newest line is a sketch's row: 1 or more fields, each a number.
  bool isRow() const { return _isRow; }

  // Returns true if the newest line is text: 4 characters or more, and no other bytes.
  bool isText() const { return _isText; }

  // Returns true once the text is a sketch's: two rows directly after each other, with the same number of columns, 2 or
  // more. Returns false again when something comes that is no text.
  bool recognised() const { return _recognised; }

 private:
  void endLine();
  void split();

  std::string _line;
  bool _returned = false;  // the newest byte was a \r, and has ended its line
  bool _text = true;       // only text has come on this line
  CsvRow _row;
  CsvRow _names;  // the line before the rows
  unsigned _garbled = 0;
  bool _isTable = false;
  bool _hasFlags = true;  // the last two columns were 0 or 1
  bool _isText = false;
  bool _isRow = false;
  size_t _columns = 0;  // of the row before
  bool _recognised = false;
};

}  // namespace line
