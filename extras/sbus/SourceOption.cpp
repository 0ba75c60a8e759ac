#include "SourceOption.h"

#include <sys/stat.h>

#include <CLI/CLI.hpp>

#include "line/CsvRows.h"
#include "line/RecordedLine.h"
#include "line/RecordingFile.h"
#include "line/SampledLine.h"
#include "line/ports/ByteStream.h"
#include "line/ports/ReopenedPort.h"

namespace tool {

namespace {

enum class Kind { Port, File, Stream, Simulated };

// A name that is neither there nor looks like a device's is a file that is missed.
Kind kindOf(const std::string &name) {
  if (name == "sim") {
    return Kind::Simulated;
  }
  struct stat status;
  if (name == "-") {
    return Kind::Stream;
  }
  if (stat(name.c_str(), &status) != 0) {
    return name.rfind("/dev/", 0) == 0 ? Kind::Port : Kind::File;
  }
  return S_ISCHR(status.st_mode) ? Kind::Port : S_ISFIFO(status.st_mode) ? Kind::Stream : Kind::File;
}

}  // namespace

SourceOption::SourceOption(CLI::App &subcommand, Recordings recordings) : _options(subcommand), _recordings(recordings) {
  subcommand.add_option("SOURCE", _name, "a serial port, a recording, - for bytes on standard input, or sim")
      ->required()
      ->check(notEmpty())
      ->type_name("");
  _csv = subcommand.add_flag("--csv", "the port carries the rows that a sketch prints, at 115200 baud");
  subcommand.add_option("--seconds", _seconds, "end after so many seconds")->check(seconds())->type_name("S");
  _simulatedTime =
      subcommand.add_flag("--simulated-time", "sim and - go as fast as they can, and come out the same each time");
}

line::LineSettings SourceOption::settings() const {
  return _csv->count() > 0 ? line::csvSettings() : _options.settings(isFile() ? _name : "");
}

bool SourceOption::isFile() const {
  return kindOf(_name) == Kind::File;
}

bool SourceOption::isStream() const {
  return kindOf(_name) == Kind::Stream;
}

bool SourceOption::isWire() const {
  return kindOf(_name) == Kind::Simulated || (isFile() && !line::isCsv(_name));
}

std::unique_ptr<Input> SourceOption::open(const line::LineSettings &port) const {
  const Kind kind = kindOf(_name);
  if (kind == Kind::Port && _simulatedTime->count() > 0) {
    throw CLI::ValidationError("--simulated-time", "is of sim and -; a port has a time of its own");
  }
  const bool atOnce = _simulatedTime->count() > 0 || (kind == Kind::File && _recordings == Recordings::AtOnce);
  return std::make_unique<Input>(openLine(port), port, atOnce ? Input::Pace::AtOnce : Input::Pace::True, _seconds);
}

std::unique_ptr<line::Line> SourceOption::openLine(const line::LineSettings &port) const {
  const Kind kind = kindOf(_name);
  if (kind != Kind::Simulated) {
    _options.rejectSimulated(_name);
  }
  if (kind == Kind::Port) {
    _options.rejectDisturbing("a port");
    return std::make_unique<line::ReopenedPort>(_name, port);
  }
  if (kind == Kind::Stream) {
    _options.rejectDisturbing("a stream of bytes");
    return std::make_unique<line::ByteStream>(_name, port.characterUs(), _simulatedTime->count() > 0);
  }
  if (kind == Kind::File) {
    rejectOtherKinds(_name);
  }
  if (kind == Kind::File && line::isCsv(_name)) {
    _options.rejectDisturbing("rows of CSV");
    return std::make_unique<line::RecordedLine>(line::readCsv(_name));
  }
  const line::Source source = _options.source(kind == Kind::File ? _name : "");
  return std::make_unique<line::SampledLine>(source.open(), source.settings, port);
}

}  // namespace tool
