// The output of the sketch's Serial: standard output, and a pseudo-terminal if there is one.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "CsvColumns.h"
#include "line/ports/PseudoTerminal.h"

namespace host {

class SketchOutput {
 public:
  // With `lineByLine` each line is visible at once, not when a buffer is full.
  void setLineByLine(bool lineByLine) { _lineByLine = lineByLine; }

  void attach(std::unique_ptr<line::PseudoTerminal> terminal) { _terminal = std::move(terminal); }

  void begin() { _begun = true; }

  // Writes if begin() has been called; as on the board, bytes are lost before. Returns how many were written.
  size_t write(const uint8_t *bytes, size_t size);

  void flush();

  const CsvColumns &columns() const { return _columns; }
  unsigned long lostBeforeBegin() const { return _lostBeforeBegin; }

 private:
  bool _begun = false;
  bool _lineByLine = false;
  unsigned long _lostBeforeBegin = 0;
  CsvColumns _columns;
  std::unique_ptr<line::PseudoTerminal> _terminal;
  std::string _terminalLine;  // not yet written to it
};

}  // namespace host
