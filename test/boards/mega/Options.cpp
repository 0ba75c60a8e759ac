#include "Options.h"

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <map>

namespace mega {

namespace {

std::string checkWire(const std::string &text) {
  return text == "1-1" || text == "2-1" || text == "3-1" ? "" : "1-1, 2-1 or 3-1 is expected";
}

}  // namespace

Options parseOptions(int argc, char **argv) {
  const std::map<std::string, line::Sticks> movements = {{"flight", line::Sticks::Flight},
                                                         {"calibration", line::Sticks::Calibration}};
  Options options;
  std::string wire;
  CLI::App app{"Runs a sketch on a simulated Arduino Mega, with the simulated receiver at Serial1."};
  app.add_option("SKETCH.elf", options.elf)->required();
  auto *recording = app.add_option("--recording", options.source.recording, "play this recording of a line, once");
  recording->type_name("FILE");
  auto *sticks = app.add_option("--sticks", options.source.sticks, "what the person at the simulated radio does (flight)");
  sticks->transform(CLI::Transformer(movements).description(""))->type_name("flight|calibration")->excludes(recording);
  auto *silent = app.add_flag("--silent", options.source.silent, "nothing comes");
  silent->excludes(recording)->excludes(sticks);
  app.add_option("--wire", wire, "a wire from TX of a port to RX of Serial1, in place of the line")
      ->check(CLI::Validator(checkWire, ""))
      ->type_name("TX-1")
      ->excludes(recording)
      ->excludes(sticks)
      ->excludes(silent);
  app.add_option("--eeprom", options.eeprom, "keep the EEPROM's contents in this file (erased at each start)")
      ->type_name("FILE");
  app.add_option("--seconds", options.seconds, "end after so many seconds (simulated receiver: 15, calibration: 40)")
      ->type_name("S");
  app.add_option("--bad", options.bad, "this character, counted from 0, has a wrong parity bit")->type_name("N");
  app.add_option("--cut", options.cut, "the line falls silent after so many seconds")->type_name("S");
  app.add_flag("--any-settings", options.anySettings, "Serial1 may be set to something else than 100000 baud, 8E2");
  app.add_flag("--frames", options.frames, "say at each line that the sketch sends how many frames came since begin()");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError &error) {
    std::exit(app.exit(error));
  }
  if (!wire.empty()) {
    options.wireFrom = wire[0] - '0';
  }
  if (options.seconds == 0 && options.source.recording.empty()) {
    options.seconds = line::choreography(options.source.sticks).periodMs / 1000.0;  // once
  }
  return options;
}

}  // namespace mega
