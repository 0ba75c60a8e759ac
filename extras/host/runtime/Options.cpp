#include "Options.h"

#include <CLI/CLI.hpp>
#include <cstdlib>

namespace host {

namespace {

// Beyond a year nobody waits, and microseconds would no longer fit where they are kept. "nan" is refused too.
std::string checkSeconds(const std::string &text) {
  constexpr double Largest = 366.0 * 24 * 60 * 60;
  char *end = nullptr;
  const double seconds = std::strtod(text.c_str(), &end);
  return *end == '\0' && seconds >= 0.001 && seconds <= Largest ? "" : "a number from 0.001 to 31622400 is expected";
}

}  // namespace

Options parseOptions(int argc, char **argv) {
  Options options;
  CLI::App app{"Runs the sketch on this PC. Its Serial is standard output; everything else goes to standard error."};

  auto *recording = app.add_option("--recording", options.recording, "play this recording of a line, once");
  recording->type_name("FILE");
  auto *port = app.add_option("--port", options.port, "listen to a receiver at this serial port, until Ctrl-C");
  port->type_name("DEVICE")->excludes(recording);
  app.add_option("--line-baud", options.lineBaud, "the line's baud rate (100000; Fast S.Bus: 200000)")
      ->check(CLI::IsMember({100000, 200000}).description(""))
      ->type_name("N")
      ->excludes(port);
  app.add_flag("--uninverted", options.uninverted, "the line is not inverted, as on a receiver's uninverted pad")
      ->excludes(port);
  app.add_option("--noise", options.noise, "so many disturbances per second are on the line, 1..100000 (none)")
      ->check(CLI::Range(1, 100000).description(""))
      ->type_name("R")
      ->excludes(port);
  app.add_flag("--silent", options.silent, "nothing comes from the simulated receiver")
      ->excludes(port)
      ->excludes(recording);
  app.add_option("--on", options.on, "the line is attached to Serial1, 2 or 3 (1)")
      ->check(CLI::Range(1, 3).description(""))
      ->type_name("1|2|3");
  app.add_option("--seconds", options.seconds, "end after so many seconds (simulated receiver: 15)")
      ->check(CLI::Validator(checkSeconds, ""))
      ->type_name("S");
  app.add_flag("--simulated-time", options.simulatedTime, "as fast as it goes, exactly repeatable")->excludes(port);
  app.add_option("--loop-us", options.loopUs, "what a pass of loop() costs, in microseconds (50)")
      ->check(CLI::Range(1, 1000000).description(""))
      ->type_name("N");
  app.add_option("--start-ms", options.startMs, "what millis() starts from (0)")->type_name("N");
  app.add_flag("--pty", options.pty, "offer the sketch's Serial on a pseudo-terminal as well");

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError &error) {
    std::exit(app.exit(error));
  }
  constexpr double SimulatedReceiverSeconds = 15;  // one flight
  if (options.seconds == 0 && options.recording.empty() && options.port.empty()) {
    options.seconds = SimulatedReceiverSeconds;
  }
  return options;
}

}  // namespace host
