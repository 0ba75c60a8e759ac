// What the columns of a capture's CSV are: of a logic analyser or an oscilloscope, told from its first rows.
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
  std::vector<std::string> names;  // of the signals
  std::vector<size_t> columns;     // theirs
  bool analogue = false;           // volts; else 0 and 1
  size_t timeColumn = None;
  double timeUnitNs = 1e9;
  // Where there is no time, the first row's, and between two rows.
  double startNs = 0;
  double periodNs = 0;
  int64_t zeroNs = 0;      // what is taken off timestamps: the first one
  uint64_t headLines = 0;  // before the first row

  // False if `field` is neither a number nor a timestamp.
  bool timeOf(std::string_view field, double &ns) const;
};

// Returns what is wrong and what is expected, or nothing. `head`: the file's first lines. `periodNs`: between two rows,
// whatever the file says; 0: the file says it.
std::string findLayout(std::string_view head, CsvLayout &layout, double periodNs = 0);

}  // namespace line
