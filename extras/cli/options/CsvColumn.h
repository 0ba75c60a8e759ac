// The columns of `sbus csv`.
#pragma once

#include <string>
#include <vector>

#include "line/Observer.h"

namespace tool {

struct CsvColumn {
  enum class Kind { Channel, Failsafe, LostFrame, Time, State, Age, Quality };

  Kind kind;
  unsigned channel;  // counted from 1
};

// Takes names and spans, "ch1-ch4,failsafe,lostframe", in the order in which they are printed. Rejects the command line
// if a word names no column.
std::vector<CsvColumn> parseColumns(const std::string &text);

// Returns true if the line has these channels. Throws std::runtime_error if one is missing a second after the first
// frame: by then all kinds of frames have come.
bool haveCome(const std::vector<CsvColumn> &columns, const line::Values &values, uint64_t sinceFirstUs);

// Returns the names of the columns: "CH1,CH2,failsafe", with a line feed.
std::string header(const std::vector<CsvColumn> &columns);

// Returns "ok", "never seen" ...
const char *stateName(sbus::LinkState state);

// Returns a row of the newest frame. Without `hasTimes` time and age are "-".
std::string row(const std::vector<CsvColumn> &columns, line::Observer &observer, uint64_t nowUs, bool hasTimes);

}  // namespace tool
