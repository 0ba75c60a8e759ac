// The output of the sketch's Serial: standard output.
#pragma once

#include <cstddef>
#include <cstdint>

#include "line/recording/CsvRows.h"

namespace host {

class SketchOutput {
 public:
  // With `lineByLine` every line is flushed, instead of full buffers.
  void setLineByLine(bool lineByLine) { _lineByLine = lineByLine; }

  void begin() { _begun = true; }

  // Writes bytes; as on the board, they are lost before begin(). Returns the number written.
  size_t write(const uint8_t *bytes, size_t size);

  void flush();

  unsigned long lines() const { return _lines; }
  unsigned long lostBeforeBegin() const { return _lostBeforeBegin; }

 private:
  bool _begun = false;
  bool _lineByLine = false;
  unsigned long _lostBeforeBegin = 0;
  line::CsvRows _rows;
  unsigned long _lines = 0;
};

}  // namespace host
