// sbus send: sends frames with values of the user's choice, to test what reads S.Bus.

#include <memory>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "cli/Sending.h"
#include "cli/SentFrames.h"
#include "cli/options/LineOptions.h"
#include "cli/subcommands/Subcommands.h"
#include "line/recording/Words.h"

namespace tool {

namespace {

struct Options {
  std::string port;
  std::vector<std::string> values;
  std::string from;
  unsigned long baud = sbus::Baud;
  double periodMs = 9;  // the paper's receiver
  double seconds = 0;
};

TimedRows rowsOf(const Options &options) {
  if (options.from.empty() == options.values.empty()) {
    rejectCommandLine(options.from.empty() ? "CH=VALUE: at least one is expected, such as ch3=172, or --from FILE.csv"
                                           : "--from: replaces " + options.values.front() + "; leave one of them out");
  }
  if (!options.from.empty()) {
    return readTimedRows(options.from);
  }
  FrameValues values;
  std::set<std::string> names;
  for (const std::string &word : options.values) {
    const std::string name = line::lower(word.substr(0, word.find('=')));
    if (!names.insert(name).second) {
      rejectCommandLine(line::quoted(word) + " sets " + name + " again; leave one of them out");
    }
    try {
      assign(word, values);
    } catch (const std::runtime_error &error) {
      rejectCommandLine(error.what());
    }
  }
  return {{{0, values}}, 0};
}

void run(Options options) {
  if (options.port.find('=') != std::string::npos) {
    options.values.insert(options.values.begin(), std::exchange(options.port, {}));
  }
  const TimedRows rows = rowsOf(options);
  line::LineSettings settings;
  settings.baud = options.baud;
  const auto periodUs = static_cast<uint64_t>(options.periodMs * 1000);
  if (periodUs <= sbus::FrameSize * settings.characterUs()) {
    rejectCommandLine(
        "--period: a frame takes 3 ms (1.5 ms at 200000 baud), and a gap follows; a longer period is expected");
  }
  Sending(options.port)
      .run(
          [&] {
            auto line = std::make_unique<FrameLine>(rows, periodUs, settings);
            return std::make_unique<Input>(std::move(line), settings, Input::Pace::True, options.seconds);
          },
          false);
}

}  // namespace

void addSend(CLI::App &app) {
  Subcommand subcommand(app, "send", "sends frames with these values, until Ctrl-C");
  const auto options = std::make_shared<Options>();
  subcommand.option("DEVICE", options->port, "a serial port; without it a pseudo-terminal, whose name is printed")
      .type("");
  subcommand.option("VALUES", options->values, "ch1=0 to ch16=2047, on (1811) or off (172); ch17=on, failsafe=on ...")
      .type("");
  subcommand.option("--from", options->from, "a file of rows as sbus csv writes them, in place of values")
      .notEmpty()
      .type("FILE.csv");
  subcommand.option("--period", options->periodMs, "the frame period, ms (9)").between(1, 1000).type("MS");
  subcommand.option("--baud", options->baud, "of the port: 200000 for Fast S.Bus (100000)")
      .oneOf({100000, 200000})
      .type("100000|200000");
  subcommand.option("--seconds", options->seconds, "end after this many seconds").seconds().type("S");
  subcommand.footer(
      "A channel without a value is in the middle, 992; CH3, the throttle, at its low end, 172; switches and flags "
      "are off. A serial port's TXD must be inverted to drive a flight controller.");
  subcommand.run([options] { run(*options); });
}

}  // namespace tool
