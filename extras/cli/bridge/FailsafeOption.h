// --failsafe of `sbus bridge`: what it sends without a link.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "cli/options/Subcommand.h"
#include "line/Statistics.h"
#include "sbus/Link.h"
#include "sbus/Scaling.h"

namespace tool {

class FailsafeOption {
 public:
  FailsafeOption() = default;  // as if it were not given
  // Adds the option to a subcommand.
  explicit FailsafeOption(Subcommand &subcommand);
  FailsafeOption(const FailsafeOption &) = delete;
  FailsafeOption &operator=(const FailsafeOption &) = delete;

  // Reads the option. Rejects the command line if it is wrong.
  void read(const sbus::Range &range);

  // Changes a frame that is sent in this state of the link; `isExtra`: one with header 2F. Returns false if nothing is
  // to be sent.
  bool apply(sbus::LinkState state, bool isExtra, line::Values &values);

 private:
  std::string _text;
  Option _option;
  std::vector<std::pair<size_t, uint16_t>> _set;  // raw values of channels, counted from 0
  line::Values _held[2];  // of the newest frame with a link, and of that with header 2F; count 0: no such frame yet
};

}  // namespace tool
