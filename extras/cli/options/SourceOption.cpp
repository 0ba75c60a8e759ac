#include "cli/options/SourceOption.h"

#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <stdexcept>
#include <utility>

#include "line/ports/ByteStream.h"
#include "line/ports/ReopenedPort.h"
#include "line/recording/CsvRows.h"
#include "line/recording/RecordedLine.h"
#include "line/simulation/NoisyLine.h"
#include "line/uart/SampledLine.h"

namespace tool {

namespace {

constexpr double YearS = 366.0 * 24 * 60 * 60;

// Keeps the characters that end within the times; `toUs` 0: to the end.
void cut(const std::string &name, FileSource &file, uint64_t fromUs, uint64_t toUs) {
  const line::Characters all = std::exchange(file.recording.characters, {});
  for (const line::Character character : all) {
    if (character.endUs >= fromUs && (toUs == 0 || character.endUs <= toUs)) {
      file.recording.characters.push_back(character);
    }
  }
  if (file.recording.characters.empty()) {
    char text[100];
    std::snprintf(text, sizeof text, ": has nothing there; it has characters from %.3f s to %.3f s",
                  static_cast<double>(all[0].endUs) / 1e6, static_cast<double>(all.back().endUs) / 1e6);
    throw std::runtime_error(name + text);
  }
}

}  // namespace

SourceOption::SourceOption(Subcommand &subcommand, Recordings recordings)
    : _options(subcommand), _recordings(recordings) {
  subcommand
      .option("SOURCE", _name, "a serial port, a recording or capture, packed or not, - for standard input, or sim")
      .required()
      .notEmpty()
      .type("");
  _csv = subcommand.flag("--csv", "the port carries the rows that a sketch prints, at 115200 baud");
  subcommand.option("--seconds", _seconds, "end after this many seconds").seconds().type("S");
  _signal = subcommand.option("--signal", _overrules.signal, "of a capture with several signals: this one (found)")
                .notEmpty()
                .type("NAME");
  _part = {subcommand.option("--from", _from, "of a file: begin at this time").between(0, YearS).type("S"),
           subcommand.option("--to", _to, "of a file: end at this time").seconds().type("S")};
  _simulatedTime =
      subcommand.flag("--simulated-time", "sim and - go as fast as they can, and come out the same each time");
}

line::LineSettings SourceOption::settings() const {
  return _csv.given() ? line::csvSettings() : isFile() ? file().settings : _options.settings();
}

// A name that does not exist is a port's if it begins with /dev/, otherwise a missing file's.
SourceOption::Kind SourceOption::kind() const {
  if (_kind) {
    return *_kind;
  }
  struct stat status;
  if (_name == "sim") {
    _kind = Kind::Simulated;
  } else if (Pipe::isPipe(_name)) {
    const auto start = std::chrono::steady_clock::now();
    _pipe = std::make_shared<Pipe>(_name);
    _kind = _csv.given() || _pipe->isLive(_seconds) ? Kind::Stream : Kind::File;
    _waitedS = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  } else if (stat(_name.c_str(), &status) != 0) {
    _kind = _name.rfind("/dev/", 0) == 0 ? Kind::Port : Kind::File;
  } else {
    _kind = S_ISCHR(status.st_mode) ? Kind::Port : Kind::File;
  }
  return *_kind;
}

bool SourceOption::isFile() const {
  return kind() == Kind::File;
}

bool SourceOption::isStream() const {
  return kind() == Kind::Stream;
}

bool SourceOption::isWire() const {
  const auto hasLevels = [](FileKind kind) { return kind == FileKind::Recording || kind == FileKind::Capture; };
  return isFile() ? hasLevels(file().kind) : kind() == Kind::Simulated;
}

bool SourceOption::hasTimes() const {
  return isFile() ? file().kind != FileKind::Bytes : !isStream();
}

void SourceOption::rejectPart(const std::string &reason) const {
  for (const Option &option : _part) {
    if (option.given()) {
      rejectCommandLine(option.name() + ": " + reason);
    }
  }
}

const FileSource &SourceOption::file() const {
  if (!_file) {
    line::Overrules overrules = _overrules;
    overrules.baud = _options.baud();
    FileSource read = readFile(_pipe ? _pipe->wholeFile() : FileName(_name), overrules);
    if (read.kind == FileKind::Rows || read.kind == FileKind::Bytes) {
      rejectPart("is for a file with times; leave it out for " + _name);
    } else if (_from > 0 || _to > 0) {
      cut(_name, read, static_cast<uint64_t>(_from * 1e6), static_cast<uint64_t>(_to * 1e6));
    }
    _file = std::make_shared<const FileSource>(std::move(read));
  }
  return *_file;
}

std::unique_ptr<Input> SourceOption::open(const line::LineSettings &port) const {
  const Kind kind = this->kind();
  if (kind == Kind::Port && _simulatedTime.given()) {
    rejectCommandLine("--simulated-time: is for sim and -; a port runs in real time");
  }
  const bool atOnce = _simulatedTime.given() || (kind == Kind::File && _recordings == Recordings::AtOnce);
  auto input =
      std::make_unique<Input>(openLine(port), port, atOnce ? Input::Pace::AtOnce : Input::Pace::True, leftSeconds());
  input->setStart(static_cast<uint64_t>(_from * 1e6));
  return input;
}

// Returns what is left of --seconds after the wait for a pipe's first bytes.
double SourceOption::leftSeconds() const {
  constexpr double LeastS = 0.001;  // 0 would be for ever
  return kind() == Kind::Stream && _seconds > 0 ? std::max(LeastS, _seconds - _waitedS) : _seconds;
}

std::unique_ptr<line::Line> SourceOption::openLine(const line::LineSettings &port) const {
  const Kind kind = this->kind();
  if (kind != Kind::Simulated) {
    _options.rejectSimulated(_name);
  }
  if (kind != Kind::File) {
    if (_signal.given()) {
      rejectCommandLine("--signal: is for a capture of several signals; leave it out for " + _name);
    }
    rejectPart("is for a file; leave it out for " + _name);
  }
  if (kind == Kind::Port) {
    _options.rejectDisturbing("a port");
    return std::make_unique<line::ReopenedPort>(_name, port);
  }
  if (kind == Kind::Stream) {
    _options.rejectDisturbing("a stream of bytes");
    if (!_csv.given() && !_pipe->hasRows()) {
      std::fprintf(stderr, "%s: brings bytes without times: times are not known\n", _name.c_str());
    }
    return std::make_unique<line::ByteStream>(_name, _pipe->descriptor(), _pipe->begin(), port.characterUs(),
                                              _simulatedTime.given());
  }
  if (kind == Kind::File) {
    return openFile(port);
  }
  const line::Source source = _options.source(_options.settings());
  return std::make_unique<line::SampledLine>(source.open(), source.settings, port);
}

std::unique_ptr<line::Line> SourceOption::openFile(const line::LineSettings &port) const {
  const FileSource &read = file();
  if (read.kind != FileKind::Recording) {
    _options.rejectDisturbing(read.kind == FileKind::Rows      ? "rows of CSV"
                              : read.kind == FileKind::Capture ? "a capture of the wire"
                                                               : "bytes without times");
  }
  const std::shared_ptr<const line::Recording> recording(_file, &read.recording);
  std::unique_ptr<line::Line> line = std::make_unique<line::RecordedLine>(recording);
  if (!isWire()) {
    return line;
  }
  const line::Source source = _options.source(read.settings);
  if (source.noise > 0) {
    line = std::make_unique<line::NoisyLine>(std::move(line), source.noise, source.settings.characterUs());
  }
  return std::make_unique<line::SampledLine>(std::move(line), source.settings, port);
}

}  // namespace tool
