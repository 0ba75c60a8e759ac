// --from and --to on the command line: a part of a file.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "cli/options/Subcommand.h"
#include "line/Format.h"

namespace tool {

class PartOption {
 public:
  // Adds both to a subcommand; it must not move afterwards.
  void addTo(Subcommand &subcommand) {
    constexpr double YearS = 366.0 * 24 * 60 * 60;
    _options = {subcommand.option("--from", _from, "begin at this time in a file").between(0, YearS).type("S"),
                subcommand
                    .option(
                        "--to", [this](double to) { setTo(to); }, "end at this time in a file")
                    .seconds()
                    .type("S")};
  }

  uint64_t fromUs() const { return static_cast<uint64_t>(std::llround(_from * 1e6)); }
  // Returns 0 without an end.
  uint64_t toUs() const { return static_cast<uint64_t>(std::llround(_to * 1e6)); }

  // Returns true if a character that ends then is in the part.
  bool has(int64_t endUs) const {
    return endUs >= static_cast<int64_t>(fromUs()) && (_to == 0 || endUs <= static_cast<int64_t>(toUs()));
  }

  // Rejects the command line if one of them is given.
  void reject(const std::string &reason) const {
    for (const Option &option : _options) {
      if (option.given()) {
        rejectCommandLine(option.name() + ": " + reason);
      }
    }
  }

 private:
  // Comes after --from, whatever their order on the command line.
  void setTo(double to) {
    _to = to;
    if (_to <= _from) {
      rejectCommandLine(line::format("--to: a time after --from, %.10g, is expected, not %.10g", _from, _to));
    }
  }

  double _from = 0;
  double _to = 0;
  std::vector<Option> _options;
};

}  // namespace tool
