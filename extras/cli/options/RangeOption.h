// --range on the command line: which raw values are -100, 0 and +100 %.
#pragma once

#include <string>

#include "cli/options/Subcommand.h"
#include "sbus/Scaling.h"

namespace tool {

class RangeOption {
 public:
  // Adds the option to a subcommand. Do not move this object afterwards.
  explicit RangeOption(Subcommand &subcommand);
  RangeOption(const RangeOption &) = delete;
  RangeOption &operator=(const RangeOption &) = delete;

  // Rejects the command line if the text is not a range.
  sbus::Range range() const;

  // Returns true if the user named a make, not raw values.
  bool isMake() const { return _text == "frsky" || _text == "futaba"; }

 private:
  std::string _text = "frsky";
};

}  // namespace tool
