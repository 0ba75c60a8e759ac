#include "LineOptions.h"

#include <CLI/CLI.hpp>
#include <cstdlib>

namespace tool {

namespace {

void refuse(const std::vector<const CLI::Option *> &options, const std::string &reason) {
  for (const CLI::Option *option : options) {
    if (option->count() > 0) {
      throw CLI::ValidationError(option->get_name(), reason);
    }
  }
}

}  // namespace

LineOptions::LineOptions(CLI::App &verb) {
  verb.add_option("--baud", _baud, "of the line: 100000, or 200000 for Fast S.Bus (100000)")
      ->check(CLI::IsMember({100000, 200000}).description(""))
      ->type_name("N");
  const CLI::Option *const channels =
      verb.add_option("--channels", _channels, "of sim; 24: FrSky's, 32: Futaba's FASSTest 26 (16)")
          ->check(CLI::IsMember({16, 24, 32}).description(""))
          ->type_name("16|24|32");
  const CLI::Option *const sticks =
      verb.add_option("--sticks", _sticks, "what the person at the radio of sim does (flight)")
          ->check(CLI::IsMember({"flight", "calibration"}).description(""))
          ->type_name("flight|calibration");
  _silent = verb.add_flag("--silent", "nothing comes from sim");
  const CLI::Option *const noise = verb.add_option("--noise", _noise, "disturbances a second, on sim or a recording")
                                       ->check(CLI::Range(1, 100000).description(""))
                                       ->type_name("N");
  _uninverted = verb.add_flag("--uninverted", "sim or a recording is not inverted, as on a receiver's uninverted pad");
  _simulated = {channels, sticks, _silent};
  _disturbing = {noise, _uninverted};
}

void LineOptions::refuseSimulated(const std::string &what) const {
  refuse(_simulated, "is of sim, the built-in receiver; leave it out for " + what);
}

void LineOptions::refuseDisturbing(const std::string &what) const {
  refuse(_disturbing, "is of sim or a recording; leave it out for " + what);
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
  source.settings.baud = _baud;
  source.settings.polarity =
      _uninverted->count() > 0 ? line::Polarity::Uninverted : line::Polarity::Inverted;
  return source;
}

std::string checkSeconds(const std::string &text) {
  constexpr double Largest = 366.0 * 24 * 60 * 60;
  char *end = nullptr;
  const double seconds = std::strtod(text.c_str(), &end);
  return *end == '\0' && seconds >= 0.001 && seconds <= Largest ? "" : "a number from 0.001 to 31622400 is expected";
}

}  // namespace tool
