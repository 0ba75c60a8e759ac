// --range on the command line: which raw values are -100, 0 and +100 %.
#pragma once

#include <cstdio>
#include <string>

#include "cli/options/Subcommand.h"
#include "line/file/Units.h"
#include "sbus/Scaling.h"

namespace tool {

class RangeOption {
 public:
  // Adds the option to a subcommand. Do not move this object afterwards.
  explicit RangeOption(Subcommand &subcommand) {
    subcommand.option("--range", _text, "the raw values at -100, 0 and +100 %: a make's, or three values (frsky)")
        .type("frsky|futaba|LOW,CENTRE,HIGH");
  }
  RangeOption(const RangeOption &) = delete;
  RangeOption &operator=(const RangeOption &) = delete;

  // Rejects the command line if the text is not a range.
  sbus::Range range() const {
    if (isMake()) {
      return _text == "frsky" ? sbus::FrSky : sbus::Futaba;
    }
    unsigned low = 0, centre = 0, high = 0;
    char more = 0;
    const bool three = std::sscanf(_text.c_str(), "%4u,%4u,%4u%c", &low, &centre, &high, &more) == 3;
    if (!three || !line::isRange(low, centre, high)) {
      rejectCommandLine("--range: frsky, futaba or raw values such as 172,992,1811 are expected, not " + _text);
    }
    return {static_cast<uint16_t>(low), static_cast<uint16_t>(centre), static_cast<uint16_t>(high)};
  }

  // Returns true if the user named a make, not raw values.
  bool isMake() const { return _text == "frsky" || _text == "futaba"; }

 private:
  std::string _text = "frsky";
};

}  // namespace tool
