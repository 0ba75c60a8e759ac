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

// Returns the value of a channel, counted from 1. On a line with 16 channels CH17 and CH18 are the switches, as in
// examples/AllChannels.
unsigned valueOf(const line::Values &values, unsigned channel);

// Takes names and spans in the order to print, "ch1-ch4,failsafe,lostframe". Rejects the command line if a word is not
// a column.
std::vector<CsvColumn> parseColumns(const std::string &text);

// Returns true if all these channels have been received. Throws std::runtime_error if one is missing a second after the
// first frame: by then all kinds of frames have been received.
bool haveAllArrived(const std::vector<CsvColumn> &columns, const line::Values &values, uint64_t sinceFirstUs);

// Returns the names of the columns with a line feed: "CH1,CH2,failsafe".
std::string header(const std::vector<CsvColumn> &columns);

// Returns "ok", "never seen" ...
const char *stateName(sbus::LinkState state);

// Returns the row for the newest frame. Without `hasTimes`, time and age are "-".
// `zeroUs`: the source's time at time 0.
std::string row(const std::vector<CsvColumn> &columns, line::Observer &observer, uint64_t nowUs, bool hasTimes,
                int64_t zeroUs);

}  // namespace tool
