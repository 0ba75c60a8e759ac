#include "cli/options/LineOptions.h"

#include <sys/stat.h>

#include <stdexcept>

namespace tool {

namespace {

void reject(const std::vector<Option> &options, const std::string &reason) {
  for (const Option &option : options) {
    if (option.given()) {
      rejectCommandLine(option.name() + ": " + reason);
    }
  }
}

}  // namespace

LineOptions::LineOptions(Subcommand &subcommand) {
  const Option baud =
      subcommand.option("--baud", _baud, "the line's baud rate: 200000 for Fast S.Bus (a recording's own, or 100000)")
          .oneOf({100000, 200000})
          .type("100000|200000");
  const Option channels =
      subcommand.option("--channels", _channels, "channels of sim; 24: FrSky's, 32: Futaba's FASSTest 26 (16)")
          .oneOf({16, 24, 32})
          .type("16|24|32");
  const Option sticks = subcommand.option("--sticks", _sticks, "how the sticks of sim move (flight)")
                            .oneOf({"flight", "calibration"})
                            .type("flight|calibration");
  _silent = subcommand.flag("--silent", "sim sends nothing");
  _sbus2 = subcommand.flag("--sbus2", "sim speaks S.BUS2: 16 channels, its own voltages, a sensor in slots 1 and 2")
               .excludes(baud)
               .excludes(channels)
               .excludes(_silent);
  const Option noise =
      subcommand.option("--noise", _noise, "disturbances a second, on sim or a recording").between(1, 100000).type("N");
  _uninverted =
      subcommand.flag("--uninverted", "sim or a recording is not inverted, as on a receiver's uninverted pad");
  _simulated = {channels, sticks, _silent, _sbus2};
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
  source.silent = _silent.given();
  source.sbus2 = _sbus2.given();
  source.sticks = _sticks == "flight" ? line::Sticks::Flight : line::Sticks::Calibration;
  source.channels = _channels == 24   ? line::Channels::TwentyFour
                    : _channels == 32 ? line::Channels::ThirtyTwo
                                      : line::Channels::Sixteen;
  source.noise = _noise;
  source.settings = settings;
  if (_uninverted.given()) {
    source.settings.polarity = line::Polarity::Uninverted;
  }
  return source;
}

void rejectSameFile(const std::string &read, const std::string &written) {
  struct stat one, other;
  if (stat(read.c_str(), &one) == 0 && stat(written.c_str(), &other) == 0 && one.st_dev == other.st_dev &&
      one.st_ino == other.st_ino && S_ISREG(one.st_mode)) {
    throw std::runtime_error(written + ": is also the input; name another file");
  }
}

}  // namespace tool
