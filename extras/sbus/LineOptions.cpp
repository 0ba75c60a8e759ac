#include "LineOptions.h"

#include <sys/stat.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

#include "line/RecordingFile.h"
#include "line/wire/Capture.h"

namespace tool {

namespace {

void reject(const std::vector<const CLI::Option *> &options, const std::string &reason) {
  for (const CLI::Option *option : options) {
    if (option->count() > 0) {
      throw CLI::ValidationError(option->get_name(), reason);
    }
  }
}

}  // namespace

line::LineSettings settingsOf(unsigned long told, const std::string &recording) {
  if (told == 0 && !recording.empty()) {
    return line::recordedSettings(recording);
  }
  line::LineSettings settings;
  settings.baud = told > 0 ? told : sbus::Baud;
  return settings;
}

LineOptions::LineOptions(CLI::App &subcommand) {
  subcommand.add_option("--baud", _baud, "of the line: 200000 for Fast S.Bus (as a recording says, or 100000)")
      ->check(CLI::IsMember({100000, 200000}).description(""))
      ->type_name("100000|200000");
  const CLI::Option *const channels =
      subcommand.add_option("--channels", _channels, "of sim; 24: FrSky's, 32: Futaba's FASSTest 26 (16)")
          ->check(CLI::IsMember({16, 24, 32}).description(""))
          ->type_name("16|24|32");
  const CLI::Option *const sticks =
      subcommand.add_option("--sticks", _sticks, "what the person at the radio of sim does (flight)")
          ->check(CLI::IsMember({"flight", "calibration"}).description(""))
          ->type_name("flight|calibration");
  _silent = subcommand.add_flag("--silent", "nothing comes from sim");
  const CLI::Option *const noise = subcommand.add_option("--noise", _noise, "disturbances a second, on sim or a recording")
                                       ->check(numberBetween(1, 100000))
                                       ->type_name("N");
  _uninverted = subcommand.add_flag("--uninverted", "sim or a recording is not inverted, as on a receiver's uninverted pad");
  _simulated = {channels, sticks, _silent};
  _disturbing = {noise, _uninverted};
}

void LineOptions::rejectSimulated(const std::string &what) const {
  reject(_simulated, "is of sim, the built-in receiver; leave it out for " + what);
}

void LineOptions::rejectDisturbing(const std::string &what) const {
  reject(_disturbing, "is of sim or a recording; leave it out for " + what);
}

line::Source LineOptions::source(const std::string &recording) const {
  line::Source source;
  source.recording = recording;
  source.silent = _silent->count() > 0;
  source.sticks = _sticks == "flight" ? line::Sticks::Flight : line::Sticks::Calibration;
  source.channels = _channels == 24   ? line::Channels::TwentyFour
                    : _channels == 32 ? line::Channels::ThirtyTwo
                                      : line::Channels::Sixteen;
  source.noise = _noise;
  source.settings = settings(recording);
  if (_uninverted->count() > 0) {
    source.settings.polarity = line::Polarity::Uninverted;
  }
  return source;
}

// "nan" is rejected, too.
CLI::Validator numberBetween(double low, double high) {
  const auto check = [low, high](const std::string &text) {
    char *end = nullptr;
    const double number = std::strtod(text.c_str(), &end);
    char expected[80];
    std::snprintf(expected, sizeof expected, "a number from %.10g to %.10g is expected", low, high);
    return *end == '\0' && number >= low && number <= high ? std::string() : expected;
  };
  return CLI::Validator(check, "");
}

CLI::Validator seconds() {
  return numberBetween(0.001, 366.0 * 24 * 60 * 60);
}

CLI::Validator notEmpty() {
  const auto check = [](const std::string &text) {
    return std::string(text.empty() ? "is empty: the name of a file or of a port is expected" : "");
  };
  return CLI::Validator(check, "");
}

void rejectPipe(const std::string &name) {
  struct stat status;
  if (name == "-" || (stat(name.c_str(), &status) == 0 && S_ISFIFO(status.st_mode))) {
    throw std::runtime_error(name + ": is a pipe, and is read more than once: save it in a file first");
  }
}

// An oscilloscope's columns may be a sketch's rows.
void rejectOtherKinds(const std::string &name) {
  const std::string head = line::beginningOf(name, line::CaptureHeadMax);
  const std::string format = line::captureFormat(head);
  if (head.rfind("time,", 0) == 0 || head.rfind("seconds,", 0) == 0) {
    throw std::runtime_error(name +
                             ": has a column of times, as sbus csv and the scope write it; only rows without are "
                             "read again. Keep the line with sbus record");
  }
  if (!format.empty() && !(format == line::OscilloscopeFormat && line::isCsv(name))) {
    throw std::runtime_error(name + ": is a capture of the wire (" + format + "), no recording: sbus decode reads it");
  }
  const auto isControl = [](unsigned char c) { return c < ' ' && c != '\t' && c != '\n' && c != '\r'; };
  if (std::any_of(head.begin(), head.end(), isControl)) {
    throw std::runtime_error(
        name + ": is no text, as a recording is; bytes as they came are read from standard input, - <" + name);
  }
}

void rejectSameFile(const std::string &read, const std::string &written) {
  struct stat one, other;
  if (stat(read.c_str(), &one) == 0 && stat(written.c_str(), &other) == 0 && one.st_dev == other.st_dev &&
      one.st_ino == other.st_ino && S_ISREG(one.st_mode)) {
    throw std::runtime_error(written + ": is what is read; name another file");
  }
}

}  // namespace tool
