// sbus replay: sends a recording again.

#include <CLI/CLI.hpp>
#include <memory>

#include "LineOptions.h"
#include "Sending.h"
#include "Subcommands.h"
#include "line/CsvRows.h"
#include "line/RecordedLine.h"
#include "line/RecordingFile.h"
#include "line/RestoredLine.h"

namespace tool {

namespace {

struct ReplayOptions {
  explicit ReplayOptions(CLI::App &subcommand) : sending(subcommand) {}

  Sending sending;
  std::string file;
  unsigned long baud = 0;
  double speed = 1;
  const CLI::Option *loop = nullptr;
};

std::unique_ptr<Input> open(const ReplayOptions &options) {
  rejectPipe(options.file);
  rejectOtherKinds(options.file);
  const bool csv = line::isCsv(options.file);
  const line::LineSettings settings = csv ? line::csvSettings() : settingsOf(options.baud, options.file);
  line::Recording recording =
      csv ? line::readCsv(options.file) : line::readRecording(options.file, settings.characterUs());
  const bool isLate = recording.characters.isLate();
  std::unique_ptr<line::Line> line = std::make_unique<line::RecordedLine>(std::move(recording));
  if (isLate) {
    line = std::make_unique<line::RestoredLine>(std::move(line), settings.characterUs());
  }
  auto input = std::make_unique<Input>(std::move(line), settings, Input::Pace::True, 0);
  input->setSpeed(options.speed);
  return input;
}

}  // namespace

void addReplay(CLI::App &app) {
  CLI::App *const subcommand = app.add_subcommand("replay", "sends a recording again, as if the receiver were there");
  const auto options = std::make_shared<ReplayOptions>(*subcommand);
  subcommand->add_option("FILE", options->file, "a recording, or rows of CSV")->required()->check(notEmpty())->type_name("");
  subcommand->add_option("--baud", options->baud, "of the recording and the port (as the recording says, or 100000)")
      ->check(CLI::IsMember({100000, 200000}).description(""))
      ->type_name("100000|200000");
  subcommand->add_option("--speed", options->speed, "so many times as fast (1)")
      ->check(numberBetween(0.001, 1000))
      ->type_name("N");
  options->loop = subcommand->add_flag("--loop", "again and again");
  subcommand->callback(
      [options] { options->sending.run([&options] { return open(*options); }, options->loop->count() > 0); });
}

}  // namespace tool
