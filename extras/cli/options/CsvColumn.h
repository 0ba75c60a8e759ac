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

// Returns 7 for "ch7"; 0 if the text is none of ch1 to ch32.
unsigned channelOf(const std::string &text);

// Returns the value of a channel, counted from 1: CH17 and CH18 of a line of 16 channels are the switches, as in
// examples/AllChannels.
unsigned valueOf(const line::Values &values, unsigned channel);

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
