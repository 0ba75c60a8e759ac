// sbus wave: the wire of a recording, as a value change dump that a logic analyser's software shows.

#include <memory>
#include <stdexcept>

#include "cli/FileSource.h"
#include "cli/Output.h"
#include "cli/Pipe.h"
#include "cli/options/LineOptions.h"
#include "cli/subcommands/Subcommands.h"
#include "line/capture/VcdWriter.h"

namespace tool {

namespace {

struct Options {
  std::string recording;
  std::string output;
  unsigned long baud = 0;  // 0: not given
  bool uninverted = false;
};

// Hands the text of the wire to `put`, piece by piece.
void wave(const FileSource &file, const Put &put) {
  line::VcdWriter writer(file.settings);
  for (const line::Character character : file.recording.characters) {
    put(writer.put(character));
  }
  put(writer.finish());
}

void run(const Options &options) {
  rejectSameFile(options.recording, options.output);
  Pipe pipe(options.recording);
  line::Overrules overrules;
  overrules.baud = options.baud;
  FileSource file = readFile(pipe.wholeFile(), overrules);
  if (file.kind == FileKind::Capture) {
    throw std::runtime_error(options.recording + ": is a capture of the wire already; sbus decode reads it");
  }
  file.settings.polarity = options.uninverted ? line::Polarity::Uninverted : line::Polarity::Inverted;
  writeTo(options.output, File::Any, [&](const Put &put) { wave(file, put); });
}

}  // namespace

void addWave(CLI::App &app) {
  Subcommand subcommand(app, "wave", "the wire of a recording as VCD, for PulseView and the like");
  const auto options = std::make_shared<Options>();
  subcommand.option("RECORDING", options->recording, "lines of \"microseconds byte byte ...\", see sbus record")
      .required()
      .notEmpty()
      .type("");
  subcommand.option("-o,--output", options->output, "a file (standard output)").type("FILE.vcd");
  subcommand
      .option("--baud", options->baud, "the line's baud rate: 200000 for Fast S.Bus (as the recording says, or 100000)")
      .oneOf({100000, 200000})
      .type("N");
  subcommand.flag("--uninverted", options->uninverted, "idle is HIGH, as on a receiver's uninverted pad");
  subcommand.run([options] { run(*options); });
}

}  // namespace tool
