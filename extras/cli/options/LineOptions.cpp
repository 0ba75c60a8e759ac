#include "cli/options/LineOptions.h"

#include <sys/stat.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

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
  reject(_simulated, "is for sim, the built-in receiver; leave it out for " + what);
}

void LineOptions::rejectDisturbing(const std::string &what) const {
  reject(_disturbing, "is for sim or a recording; leave it out for " + what);
}

line::LineSettings LineOptions::settings() const {
  line::LineSettings settings;
  settings.baud = _baud > 0 ? _baud : sbus::Baud;
  return settings;
}

line::Source LineOptions::source(const line::LineSettings &settings) const {
  line::Source source;
  source.silent = _silent->count() > 0;
  source.sticks = _sticks == "flight" ? line::Sticks::Flight : line::Sticks::Calibration;
  source.channels = _channels == 24   ? line::Channels::TwentyFour
                    : _channels == 32 ? line::Channels::ThirtyTwo
                                      : line::Channels::Sixteen;
  source.noise = _noise;
  source.settings = settings;
  if (_uninverted->count() > 0) {
    source.settings.polarity = line::Polarity::Uninverted;
  }
  return source;
}

// "nan" is rejected as well.
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

CLI::Validator notStandardOutput() {
  const auto check = [](const std::string &name) {
    const bool isFile = !name.empty() && name != "-";
    return std::string(isFile ? "" : "the name of a file is expected; standard output is taken");
  };
  return CLI::Validator(check, "");
}

void rejectPipe(const std::string &name) {
  struct stat status;
  if (name == "-" || (stat(name.c_str(), &status) == 0 && S_ISFIFO(status.st_mode))) {
    throw std::runtime_error(name + ": is a pipe, and is read more than once: save it in a file first");
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
