// The columns of `sbus csv`.
#pragma once

#include <string>
#include <vector>

#include "line/Observer.h"

namespace tool {

struct CsvColumn {
  enum class Kind { Channel, Failsafe, LostFrame, Time, State, Age };

  Kind kind;
  unsigned channel;  // counted from 1
};

// "ch1-ch4,failsafe,lostframe": names and spans, in the order in which they are to be printed. Rejects the command line
// if a word is none of these.
std::vector<CsvColumn> parseColumns(const std::string &text);

// True if the line has these channels. Throws std::runtime_error if it has not, a second after the first frame: by then
// all kinds of frames have come.
bool haveCome(const std::vector<CsvColumn> &columns, const line::Values &values, uint64_t sinceFirstUs);

// "CH1,CH2,failsafe", with CR and LF as Serial.println() has them.
std::string header(const std::vector<CsvColumn> &columns);

// "ok", "never seen" ...
const char *stateName(sbus::LinkState state);

// A row of the newest frame.
std::string row(const std::vector<CsvColumn> &columns, line::Observer &observer, uint64_t nowUs);

}  // namespace tool
