// A condition on a line: failsafe || ch5>1500 && !(age>50ms).
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "cli/options/Scanner.h"
#include "line/Observer.h"
#include "sbus/Scaling.h"

namespace tool {

class Condition {
 public:
  // Reads the text of an option. Rejects the command line, with the place, if it is wrong.
  Condition(const char *option, const std::string &text, const sbus::Range &range);

  // Returns true if it holds at `nowUs`; false before the first frame.
  bool holds(line::Observer &observer, uint64_t nowUs) const;

 private:
  struct Now {
    const line::Values &values;
    sbus::LinkState state;
    uint64_t ageUs;
    unsigned quality;  // percent
  };
  using Test = std::function<bool(const Now &)>;
  using Comparison = std::function<bool(double, double)>;

  static Test either(Scanner &scanner, const sbus::Range &range);
  static Test both(Scanner &scanner, const sbus::Range &range);
  static Test single(Scanner &scanner, const sbus::Range &range);
  static Test named(Scanner &scanner, const sbus::Range &range);
  static Test channel(unsigned channel, Scanner &scanner, const sbus::Range &range);
  static Comparison comparison(Scanner &scanner);

  Test _test;
};

}  // namespace tool
