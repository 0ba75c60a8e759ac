// Finds out from the first rows what the columns of a logic analyser's or an oscilloscope's CSV hold.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "line/recording/Words.h"

namespace line {

// Returns true if `text` has one of these words, in any case. A micro sign in any encoding counts as u.
bool hasWord(std::string_view text, std::initializer_list<std::string_view> words);

// Returns the unit of time that a text names, in ns, or 0 if it names none.
double unitIn(std::string_view text);

// Returns the same; by default a second.
double unitOf(std::string_view title);

// A column of times.
struct TimeColumn {
  static constexpr size_t None = SIZE_MAX;

  size_t column = None;
  double unitNs = 1e9;
  char decimalMark = '.';
  int64_t zeroNs = 0;  // of dates: the first row's, in ns since 1970

  // Reads a row's time. Returns what is wrong, or nothing.
  std::string read(const Fields &fields, double &ns) const;
};

struct CsvSignal {
  std::string name;
  size_t column;
};

struct CsvLayout {
  std::string name;  // "PulseView CSV"
  char separator = ',';
  std::vector<CsvSignal> signals;  // by column
  bool analogue = false;           // volts; otherwise 0 and 1
  TimeColumn time;
  // Without a column of times: the time of the first row, and between two rows.
  double startNs = 0;
  double periodNs = 0;
  uint64_t headLines = 0;  // before the first row
};

// Finds the layout. Returns what is wrong and what is expected, or nothing. `head`: the file's first lines. `periodNs`:
// the time between two rows, which overrides the file's; 0: the file's.
std::string findLayout(std::string_view head, CsvLayout &layout, double periodNs);

}  // namespace line
