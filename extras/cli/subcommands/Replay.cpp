// sbus replay: sends a recording again.

#include <memory>
#include <utility>

#include "cli/FileSource.h"
#include "cli/Pipe.h"
#include "cli/Sending.h"
#include "cli/options/LineOptions.h"
#include "cli/subcommands/Subcommands.h"
#include "line/recording/RecordedLine.h"
#include "line/recording/RestoredLine.h"

namespace tool {

namespace {

struct ReplayOptions {
  explicit ReplayOptions(Subcommand &subcommand) : sending(subcommand) {}

  Sending sending;
  std::string file;
  line::Overrules overrules;
  double speed = 1;
  Option loop;
};

std::unique_ptr<Input> open(const std::shared_ptr<const FileSource> &file, double speed) {
  const std::shared_ptr<const line::Recording> recording(file, &file->recording);
  std::unique_ptr<line::Line> line = std::make_unique<line::RecordedLine>(recording);
  if (recording->characters.isLate()) {
    line = std::make_unique<line::RestoredLine>(std::move(line), file->settings.characterUs());
  }
  auto input = std::make_unique<Input>(std::move(line), file->settings, Input::Pace::True, 0);
  input->setSpeed(speed);
  return input;
}

void run(const ReplayOptions &options) {
  Pipe pipe(options.file);
  const auto file = std::make_shared<const FileSource>(readFile(pipe.wholeFile(), options.overrules));
  options.sending.run([&] { return open(file, options.speed); }, options.loop.given());
}

}  // namespace

void addReplay(CLI::App &app) {
  Subcommand subcommand(app, "replay", "sends a recording again, as if the receiver were there");
  const auto options = std::make_shared<ReplayOptions>(subcommand);
  subcommand.option("FILE", options->file, "a recording, rows of CSV, a capture, or bytes")
      .required()
      .notEmpty()
      .type("");
  subcommand
      .option("--baud", options->overrules.baud, "baud rate of recording and port (as the recording says, or 100000)")
      .oneOf({100000, 200000})
      .type("100000|200000");
  subcommand.option("--signal", options->overrules.signal, "of a capture with several signals: this one (found)")
      .notEmpty()
      .type("NAME");
  subcommand.option("--speed", options->speed, "this many times as fast (default: 1)").between(0.001, 1000).type("N");
  options->loop = subcommand.flag("--loop", "repeats it until Ctrl-C");
  subcommand.run([options] { run(*options); });
}

}  // namespace tool
