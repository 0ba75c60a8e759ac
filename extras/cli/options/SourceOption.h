// SOURCE on the command line: a port, a file, -, sim or values; and the options that go with it.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/FileSource.h"
#include "cli/Input.h"
#include "cli/Json.h"
#include "cli/Pipe.h"
#include "line/file/TableReader.h"
#include "cli/options/PartOption.h"
#include "cli/options/Subcommand.h"
#include "line/Source.h"

namespace tool {

// How a file is read: in real time; as fast as possible; or as fast as possible, and several times.
enum class Playback { RealTime, AtOnce, Repeatable };

// What a subcommand does with rows of CSV that are no frames. Sent: with --rows, as they are; SOURCE may be several
// words such as ch3=172 ch5=on.
enum class Rows { Shown, Sent, Rejected };

class SourceOption {
 public:
  // Adds SOURCE, or an argument with another `name`, and its options to a subcommand.
  SourceOption(Subcommand &subcommand, Playback playback, Rows rows = Rows::Shown, const char *name = "SOURCE");
  // Adds --rows, for a subcommand that can do something with a sketch's rows from a port.
  void addRows(Subcommand &subcommand);
  // A second source, named by another option or argument, with the options of `first`; `signal`, if given, is its own.
  // Create it after the command line has been read.
  SourceOption(const SourceOption &first, const std::string &word, const Option &given = Option(),
               const std::string &signal = {});
  SourceOption(const SourceOption &) = delete;
  SourceOption &operator=(const SourceOption &) = delete;

  // Opens the source as a port with settings() would receive it. Throws std::runtime_error.
  std::unique_ptr<Input> open() const { return open(settings()); }

  // Opens the source with other settings. A serial port's polarity is set in its adapter.
  std::unique_ptr<Input> open(const line::LineSettings &port) const;

  // Returns 8E2, inverted, at --baud; for a file its own settings; with --rows a sketch's Serial, 115200 baud, 8N1.
  // Throws std::runtime_error if the source is a file that cannot be read.
  line::LineSettings settings() const;

  // Returns settings() with the line's own polarity.
  line::LineSettings lineSettings() const;

  // Returns the name of the file or port, "-", "sim" or the values.
  const std::string &name() const { return parsed().name; }

  bool isFile() const { return parsed().kind == Kind::File; }
  bool isStream() const { return parsed().kind == Kind::Stream; }

  // Returns true for a port, and for a pipe that is written while it is played: what waits there becomes old.
  bool isLive() const;
  // Returns false for a live source with a sketch's rows.
  bool hasFrames() const { return !_given.asRows.given() && !(isStream() && _pipe->hasRows()); }

  // Throws std::runtime_error if it is a pipe that has ended without a byte.
  void rejectEmpty() const;

  // Returns true if the levels are known, so a port of either polarity can receive them: sim, recordings, captures.
  bool isWire() const;
  // Returns true if its times are the line's; false for a file of bytes and for a pipe's bytes.
  bool hasTimes() const { return isFile() ? file().hasTimes : !isStream(); }
  // Returns time 0 in us since 1970, which is now for a port or a pipe; nothing if it is unknown.
  std::optional<int64_t> startUs() const { return isFile() ? file().startUs : _startUs; }
  // Returns the source's time when a character's time is 0; below 0 for a file that begins before its own time 0.
  int64_t zeroUs() const { return isFile() ? file().zeroUs : 0; }
  // Returns a character's time in the source's time; nothing if times are not known.
  std::optional<double> shownUs(uint64_t us) const;
  // Returns the first JSON line. Call it after open().
  Json json() const;
  const FileSource &file() const;

  // Both are for a subcommand that sends: values are sent as a frame every `periodUs`.
  void setPeriod(uint64_t periodUs) { _given.periodUs = periodUs; }
  void setRange(const sbus::Range &range) { _given.range = range; }

 private:
  enum class Kind { Port, File, Stream, Simulated, Values };

  // The command line's options, which two sources share.
  struct Given {
    Playback playback = Playback::RealTime;
    Rows rows = Rows::Shown;
    unsigned long baud = 0;  // 0: not given
    double seconds = 0;
    Option asRows;
    PartOption part;
    Option simulatedTime;
    Option signal;
    line::Overrides overrides;
    uint64_t periodUs = 9000;
    sbus::Range range = sbus::FrSky;
  };

  struct Parsed {
    std::string name;
    Kind kind;
    line::Source source;
    line::FrameValues values;
  };

  const Parsed &parsed() const;
  Parsed parse() const;
  Parsed parseValues() const;
  void openPipe(Parsed &parsed) const;
  double leftSeconds() const;
  std::unique_ptr<line::Line> openLine(const line::LineSettings &port) const;
  std::unique_ptr<line::Line> openFile(const line::LineSettings &port) const;
  std::unique_ptr<line::Line> openText() const;
  void rejectOptions(const Parsed &parsed) const;
  void rejectRows() const;
  static void rejectDisturbing(const Parsed &parsed, const char *what);

  Given _given;
  std::vector<std::string> _words;
  std::string _word;
  mutable std::optional<Parsed> _parsed;            // once it is known
  mutable std::shared_ptr<Pipe> _pipe;              // standard input or a FIFO
  mutable bool _isLiveText = false;                 // the pipe is played while it is being written
  mutable bool _isAtOnce = false;                   // the pipe holds a file, which comes at once
  mutable double _waitedS = 0;                      // for its first bytes
  mutable std::shared_ptr<const FileSource> _file;  // once it has been read
  mutable std::optional<int64_t> _startUs;          // a port's or pipe's, once it is open
};

}  // namespace tool
