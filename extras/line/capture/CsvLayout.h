// Finds out from the first rows what the columns of a logic analyser's or an oscilloscope's CSV hold.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "line/capture/CsvFields.h"

namespace line {

struct CsvLayout {
  static constexpr size_t None = SIZE_MAX;

  std::string name;  // "PulseView CSV"
  char separator = ',';
  char decimalMark = '.';
  std::vector<std::string> names;  // the signals'
  std::vector<size_t> columns;     // the signals'
  bool analogue = false;           // volts; otherwise 0 and 1
  size_t timeColumn = None;
  double timeUnitNs = 1e9;
  // Without a column of times: the time of the first row, and between two rows.
  double startNs = 0;
  double periodNs = 0;
  int64_t zeroNs = 0;      // times count from here, the first timestamp
  uint64_t headLines = 0;  // before the first row

  // Reads a time. Returns false if `field` is neither a number nor a timestamp.
  bool timeOf(std::string_view field, double &ns) const;
};

// Finds the layout. Returns what is wrong and what is expected, or nothing. `head`: the file's first lines. `periodNs`:
// the time between two rows, which overrides the file's; 0: the file's.
std::string findLayout(std::string_view head, CsvLayout &layout, double periodNs);

}  // namespace line
