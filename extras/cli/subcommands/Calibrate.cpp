// sbus calibrate: measures the raw values that a transmitter's sticks really send.

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>

#include "cli/CalibrationFile.h"
#include "cli/CalibrationGuide.h"
#include "cli/Output.h"
#include "cli/options/SourceOption.h"
#include "cli/subcommands/Subcommands.h"
#include "line/Observer.h"
#include "line/system/System.h"

namespace tool {

namespace {

// Returns true if Enter was pressed. Throws std::runtime_error if standard input has ended.
bool isEnterPressed() {
  if (!line::isReadable(STDIN_FILENO, 0)) {
    return false;
  }
  char keys[100];
  const ssize_t count = read(STDIN_FILENO, keys, sizeof keys);
  if (count <= 0) {
    throw std::runtime_error("standard input has ended, so Enter cannot be pressed; run it in a terminal");
  }
  return std::find(keys, keys + count, '\n') != keys + count;
}

sbus::Calibration measure(Input &input) {
  CalibrationGuide guide([](const std::string &text) { std::fprintf(stderr, "%s\n", text.c_str()); });
  line::Observer observer;
  observer.reset(0, input.settings().characterUs());
  observer.listen([&](const line::Stretch &stretch) {
    if (stretch.isFrame()) {
      guide.take(observer.newest(), stretch.endUs());
    }
  });
  input.run([&](const line::Character &character) { observer.put(character); },
            [&](uint64_t nowUs) {
              observer.idleUntil(input.knownUs());
              if (!guide.waitsForEnter()) {
                guide.tick(nowUs, observer.hasLink(nowUs));
              } else if (isEnterPressed()) {
                guide.pressEnter();
              }
              if (guide.isDone()) {
                input.end();
              }
            });
  return guide.calibration();
}

void run(const SourceOption &source, const std::string &name) {
  if (source.name() == "-") {
    rejectCommandLine("-: standard input is where Enter is pressed; name a port or a file");
  }
  const std::unique_ptr<Input> input = source.open();
  // The file is opened first: if it cannot be written, the user learns it before moving the sticks.
  writeTo(name, File::New, [&](const Put &put) {
    const std::string text = calibrationText(measure(*input));
    put(text);
    std::fprintf(stderr, "%s:\n%s", name.empty() ? "-" : name.c_str(), text.c_str());
  });
}

}  // namespace

void addCalibrate(CLI::App &app) {
  Subcommand subcommand(app, "calibrate", "measures the ends and the centre of each channel, for joystick");
  const auto source = std::make_shared<SourceOption>(subcommand, Playback::RealTime, Rows::Rejected);
  const auto name = std::make_shared<std::string>();
  subcommand
      .option("-o,--output", *name, "the file to write; an existing file is not overwritten (standard output)")
      .type("FILE");
  subcommand.footer(
      "It guides you in three steps. CH1 to CH4 must be sticks; channels that hardly moved are left out.");
  subcommand.run([source, name] { run(*source, *name); });
}

}  // namespace tool
