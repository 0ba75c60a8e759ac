// --unit and --range on the command line: the unit of the channels in JSON lines.
#pragma once

#include <string>

#include "cli/Json.h"
#include "cli/options/RangeOption.h"
#include "cli/options/Subcommand.h"

namespace tool {

class ChannelFormOption {
 public:
  // Adds both to a subcommand. Do not move this object afterwards.
  explicit ChannelFormOption(Subcommand &subcommand) : _range(subcommand) {
    _unit = subcommand.option("--unit", _text, "the unit of the channels in JSON lines (raw)")
                .oneOf({"raw", "us", "percent"})
                .type("raw|us|percent");
  }

  // Rejects the command line if --range is not a range, or if --unit is given without JSON lines, which alone have it.
  ChannelForm form(bool isJson) const {
    if (_unit.given() && !isJson) {
      rejectCommandLine("--unit: is for JSON lines; add --json, or leave it out");
    }
    return {_text == "us" ? line::Unit::Us : _text == "percent" ? line::Unit::Percent : line::Unit::Raw, _range.range()};
  }

 private:
  RangeOption _range;
  Option _unit;
  std::string _text = "raw";
};

}  // namespace tool
