// The options that say what is on a line: how it is set, and what the built-in receiver sends.
#pragma once

#include <string>
#include <vector>

#include "cli/options/Subcommand.h"
#include "line/Source.h"

namespace tool {

class LineOptions {
 public:
  // Adds them to a subcommand; it must not move afterwards.
  explicit LineOptions(Subcommand &subcommand);
  LineOptions(const LineOptions &) = delete;
  LineOptions &operator=(const LineOptions &) = delete;

  // Each rejects the command line if one of these options was given: they do not apply to `what`, such as "a port".
  void rejectSimulated(const std::string &what) const;   // those of the built-in receiver
  void rejectDisturbing(const std::string &what) const;  // --noise and --uninverted

  // Returns the built-in receiver, or the disturbances, that the options ask for, on a line with these settings.
  line::Source source(const line::LineSettings &settings) const;

  // Returns S.Bus at --baud. Default: 100000.
  line::LineSettings settings() const;

  // Returns --baud; 0 without it.
  unsigned long baud() const { return _baud; }

 private:
  unsigned long _baud = 0;  // 0: not given
  std::string _sticks = "flight";
  int _channels = 16;
  unsigned _noise = 0;
  std::vector<Option> _simulated;
  std::vector<Option> _disturbing;
  Option _silent;
  Option _sbus2;
  Option _uninverted;
};

// Throws std::runtime_error if the output is also the input.
void rejectSameFile(const std::string &read, const std::string &written);

}  // namespace tool
