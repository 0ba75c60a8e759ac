#include "cli/options/RangeOption.h"

#include <cstdio>

#include "line/file/Units.h"

namespace tool {

RangeOption::RangeOption(Subcommand &subcommand) {
  subcommand.option("--range", _text, "the raw values at -100, 0 and +100 %: a make's, or three values (frsky)")
      .type("frsky|futaba|LOW,CENTRE,HIGH");
}

sbus::Range RangeOption::range() const {
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

}  // namespace tool
