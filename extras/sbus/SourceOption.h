// SOURCE on the command line: a port, a recording, rows of CSV, - or sim; and the options that go with it.
#pragma once

#include <memory>

#include "Input.h"
#include "LineOptions.h"

namespace tool {

// Whether a recording goes in true time, as on a page, or as fast as it can. All else goes in true time.
enum class Recordings { InTrueTime, AtOnce };

class SourceOption {
 public:
  // Adds SOURCE and its options to a subcommand.
  SourceOption(CLI::App &subcommand, Recordings recordings);

  // As a port hears it that is set as the options say: settings(). Throws std::runtime_error.
  std::unique_ptr<Input> open() const { return open(settings()); }

  // The same with another setting. The polarity of a serial port is its adapter's affair.
  std::unique_ptr<Input> open(const line::LineSettings &port) const;

  // 8E2 and inverted, at --baud; with --csv what a sketch's Serial has, 115200 baud, 8N1.
  line::LineSettings settings() const;

  const std::string &name() const { return _name; }

  bool isFile() const;
  bool isStream() const;
  // Its levels are known, so that a port of either polarity can hear it: sim and recordings.
  bool isWire() const;

 private:
  std::unique_ptr<line::Line> openLine(const line::LineSettings &port) const;

  LineOptions _options;
  Recordings _recordings;
  std::string _name;
  double _seconds = 0;
  const CLI::Option *_csv;
  const CLI::Option *_simulatedTime;
};

}  // namespace tool
