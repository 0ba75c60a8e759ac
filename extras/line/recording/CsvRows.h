// The rows of numbers that a sketch prints, as serial plotters take them: 1048,992,172,992,0,1 or 1048 992 or
// throttle:172,roll:992, with commas, tabs or blanks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "line/Line.h"
#include "line/simulation/LineSettings.h"

namespace line {

struct CsvField {
  std::string text;  // the number as it was printed
  std::string name;  // of "name:number"; else empty
  double value = 0;
  bool isNumber = false;
};

using CsvRow = std::vector<CsvField>;

// What a column holds.
enum class CsvKind { Channel, Failsafe, LostFrame, Switch17, Switch18 };

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

  // What a column of the newest row holds: as its name says, or a line of names before the rows. Without names the last
  // two of 6 are flags, as examples/DecodeSBus prints them, and the last two of 18 are switches, as
  // examples/AllChannels prints them, as long as nothing but 0 and 1 has stood there.
  CsvKind kind(size_t column) const;

  // Bytes that are no text, since the beginning: many of them if the baud rate is wrong.
  unsigned garbled() const { return _garbled; }

  // The newest line has a comma or a name: it is no line of a recording.
  bool isTable() const { return _isTable; }

  // The newest line is one of a sketch's rows: 1 or more fields, each a number.
  bool isRow() const { return _isRow; }

  // The newest line is text: 4 characters or more, and no other bytes.
  bool isText() const { return _isText; }

  // True once the text is a sketch's: two rows in a row, of 2 or more columns, and as many in both. False again when
  // something comes that is no text.
  bool recognised() const { return _recognised; }

 private:
  void endLine();
  void split();

  std::string _line;
  bool _text = true;  // nothing else has come on this line
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
