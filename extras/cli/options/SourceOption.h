// SOURCE on the command line: a port, a file, - or sim; and the options that go with it.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/FileSource.h"
#include "cli/Input.h"
#include "cli/Pipe.h"
#include "cli/options/LineOptions.h"

namespace tool {

// Says whether a recording runs in real time, as on a page, or as fast as it can. All other sources run in real time.
enum class Recordings { InTrueTime, AtOnce };

class SourceOption {
 public:
  // Adds SOURCE and its options to a subcommand.
  SourceOption(Subcommand &subcommand, Recordings recordings);

  // Opens the source, as a port with settings() hears it. Throws std::runtime_error.
  std::unique_ptr<Input> open() const { return open(settings()); }

  // Opens the source with another setting. The polarity of a serial port is set in its adapter.
  std::unique_ptr<Input> open(const line::LineSettings &port) const;

  // Returns 8E2, inverted, at --baud; for a file its own settings; with --csv 115200 baud, 8N1, as a sketch's Serial.
  // Throws std::runtime_error if the source is a file that cannot be read.
  line::LineSettings settings() const;

  const std::string &name() const { return _name; }

  bool isFile() const;
  bool isStream() const;
  // Returns true if its levels are known, so that a port of either polarity can hear it: sim, recordings, captures.
  bool isWire() const;
  // Returns true if its times are those of the line; false for a file of bytes, and for what a pipe brings.
  bool hasTimes() const;

 private:
  enum class Kind { Port, File, Stream, Simulated };

  Kind kind() const;
  double leftSeconds() const;
  std::unique_ptr<line::Line> openLine(const line::LineSettings &port) const;
  std::unique_ptr<line::Line> openFile(const line::LineSettings &port) const;
  const FileSource &file() const;
  void rejectPart(const std::string &reason) const;

  LineOptions _options;
  Recordings _recordings;
  std::string _name;
  double _seconds = 0;
  double _from = 0;  // seconds
  double _to = 0;    // 0: to the end
  Option _csv;
  std::vector<Option> _part;  // --from and --to
  Option _simulatedTime;
  Option _signal;
  line::Overrules _overrules;
  mutable std::optional<Kind> _kind;                // once it is known
  mutable std::shared_ptr<Pipe> _pipe;              // of standard input, and of a FIFO
  mutable double _waitedS = 0;                      // for its first bytes
  mutable std::shared_ptr<const FileSource> _file;  // once it has been read
};

}  // namespace tool
