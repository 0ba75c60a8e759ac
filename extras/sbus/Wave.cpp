// sbus wave: the wire of a recording, as a value change dump that a logic analyser's software shows.

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <memory>
#include <stdexcept>

#include "Output.h"
#include "Verbs.h"
#include "line/RecordingFile.h"
#include "line/wire/VcdWriter.h"

namespace tool {

namespace {

struct Options {
  std::string recording;
  std::string output;
  line::LineSettings settings;
  bool uninverted = false;
};

// The whole text of the wire goes to `put`, piece by piece.
template <typename Put>
void wave(const line::Recording &recording, const line::LineSettings &settings, Put put) {
  line::VcdWriter writer(settings);
  for (const line::Character &character : recording.characters) {
    put(writer.put(character));
  }
  put(writer.finish());
}

void run(Options options) {
  options.settings.polarity = options.uninverted ? line::Polarity::Uninverted : line::Polarity::Inverted;
  const line::Recording recording = line::readRecording(options.recording, options.settings.characterUs());
  if (options.output.empty()) {
    wave(recording, options.settings, write);
    flush();
    return;
  }
  std::ofstream file(options.output, std::ios::binary);
  wave(recording, options.settings, [&file](const std::string &text) { file << text; });
  file.close();
  if (!file) {
    throw std::runtime_error(options.output + ": cannot be written (" + std::strerror(errno) + "); name another file");
  }
}

}  // namespace

void addWave(CLI::App &app) {
  CLI::App *const verb = app.add_subcommand("wave", "the wire of a recording as VCD, for PulseView and the like");
  const auto options = std::make_shared<Options>();
  verb->add_option("RECORDING", options->recording, "lines of \"microseconds byte byte ...\", see sbus record")
      ->required()
      ->type_name("");
  verb->add_option("-o,--output", options->output, "a file (standard output)")->type_name("FILE.vcd");
  verb->add_option("--baud", options->settings.baud, "of the line: 100000, or 200000 for Fast S.Bus (100000)")
      ->check(CLI::IsMember({100000, 200000}).description(""))
      ->type_name("N");
  verb->add_flag("--uninverted", options->uninverted, "idle is HIGH, as on a receiver's uninverted pad");
  verb->callback([options] { run(*options); });
}

}  // namespace tool
