// --from and --to on the command line: a part of a file, in its own time.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
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
    const auto option = [&](const char *name, std::optional<double> &s, const char *what) {
      return subcommand
          .option(
              name,
              [this, &s](double seconds) {
                s = seconds;
                check();
              },
              what)
          .between(-YearS, YearS)
          .type("S");
    };
    _options = {option("--from", _fromS, "begin at this time in a file; below 0 is before its trigger"),
                option("--to", _toS, "end at this time in a file")};
  }

  // Return the part in us from `zeroUs` on, which is not above 0: see line::FileHead. 0 is no end.
  uint64_t fromUs(int64_t zeroUs) const { return _fromS ? since(*_fromS, zeroUs, 0) : 0; }
  uint64_t toUs(int64_t zeroUs) const { return _toS ? since(*_toS, zeroUs, 1) : 0; }

  bool given() const { return _fromS || _toS; }

  // Returns true if a character that ends at this time of the file is in the part.
  bool has(int64_t endUs) const {
    return (!_fromS || endUs >= std::llround(*_fromS * 1e6)) && (!_toS || endUs <= std::llround(*_toS * 1e6));
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
  static uint64_t since(double seconds, int64_t zeroUs, int64_t leastUs) {
    return static_cast<uint64_t>(std::max<int64_t>(leastUs, std::llround(seconds * 1e6) - zeroUs));
  }

  void check() const {
    if (_fromS && _toS && *_toS <= *_fromS) {
      rejectCommandLine(line::format("--to: a time after --from, %.10g, is expected, not %.10g", *_fromS, *_toS));
    }
  }

  std::optional<double> _fromS;
  std::optional<double> _toS;
  std::vector<Option> _options;
};

}  // namespace tool
