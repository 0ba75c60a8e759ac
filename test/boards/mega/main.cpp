// Runs a sketch on a simulated Arduino Mega, with a line at Serial1. What the sketch sends over Serial is standard
// output, all else standard error. Fails if the sketch sets a port wrongly, or does not fetch characters in time.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <utility>

#include "LineInput.h"
#include "LineVariants.h"
#include "Mega.h"
#include "runtime/RecordedLine.h"
#include "runtime/SilentLine.h"
#include "runtime/SimulatedReceiver.h"

namespace {

constexpr double FlightSeconds = 15;
constexpr unsigned long SerialBaud = 115200;
constexpr unsigned long SerialBaudError = 40;  // 1/40: an AVR at 16 MHz sends at 117647, 2.1 % too fast

struct Options {
  std::string elf;
  std::string recording;
  bool silent = false;
  double seconds = 0;  // 0: as long as there is something to come
  long bad = -1;       // number of a character, or -1
  double cut = 0;      // s; 0: not at all
  bool anySettings = false;
  bool frames = false;
};

Options parseOptions(int argc, char **argv) {
  Options options;
  CLI::App app{"Runs a sketch on a simulated Arduino Mega, with the simulated receiver at Serial1."};
  app.add_option("SKETCH.elf", options.elf)->required();
  app.add_option("--recording", options.recording, "play this recording of a line, once")->type_name("FILE");
  app.add_flag("--silent", options.silent, "nothing comes");
  app.add_option("--seconds", options.seconds, "end after so many seconds (simulated receiver: 15)")->type_name("S");
  app.add_option("--bad", options.bad, "this character, counted from 0, has a wrong parity bit")->type_name("N");
  app.add_option("--cut", options.cut, "the line falls silent after so many seconds")->type_name("S");
  app.add_flag("--any-settings", options.anySettings, "Serial1 may be set to something else than 100000 baud, 8E2");
  app.add_flag("--frames", options.frames, "say at each line that the sketch sends how many frames came since begin()");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError &error) {
    std::exit(app.exit(error));
  }
  if (options.seconds == 0 && options.recording.empty()) {
    options.seconds = FlightSeconds;
  }
  return options;
}

std::unique_ptr<host::Line> makeGoodLine(const Options &options) {
  if (options.silent) {
    return std::make_unique<host::SilentLine>();
  }
  if (options.recording.empty()) {
    return std::make_unique<host::SimulatedReceiver>();
  }
  std::ifstream in(options.recording, std::ios::binary);
  host::Recording recording = host::parseRecording(in);
  if (!recording.error.empty()) {
    throw std::runtime_error(options.recording + ": " + recording.error);
  }
  return std::make_unique<host::RecordedLine>(std::move(recording));
}

std::unique_ptr<host::Line> makeLine(const Options &options) {
  std::unique_ptr<host::Line> line = makeGoodLine(options);
  if (options.bad >= 0) {
    line = std::make_unique<mega::OneBadCharacter>(std::move(line), static_cast<unsigned long>(options.bad));
  }
  if (options.cut > 0) {
    line = std::make_unique<mega::CutLine>(std::move(line), static_cast<uint64_t>(options.cut * 1e6));
  }
  return line;
}

// Serial: 115200 baud as near as the processor comes to it, 8N1.
bool isSerialRight(const host::PortSettings &settings) {
  const unsigned long error = settings.baud > SerialBaud ? settings.baud - SerialBaud : SerialBaud - settings.baud;
  return error <= SerialBaud / SerialBaudError && settings.format() == host::Format{8, host::Parity::None, 1};
}

void report(const mega::LineInput &input) {
  std::fprintf(stderr, "sent: %lu frames, the last through at %llu us; %lu characters, %lu of them bad\n",
               input.frames(), static_cast<unsigned long long>(input.lastFrameUs()), input.characters(),
               input.badCharacters());
}

bool judge(const mega::Mega &mega, const mega::LineInput &input, const Options &options) {
  bool good = true;
  if (!isSerialRight(mega.settings(0))) {
    std::fprintf(stderr, "Serial is not set to 115200 baud, 8N1, but to %s\n", text(mega.settings(0)).c_str());
    good = false;
  }
  if (!input.wrongSettings().empty() && !options.anySettings) {
    std::fprintf(stderr, "Serial1 was set wrongly: %s\n", input.wrongSettings().c_str());
    good = false;
  }
  if (input.overruns() != 0) {
    std::fprintf(stderr, "Serial1 lost %lu characters that were not fetched in time\n", input.overruns());
    good = false;
  }
  return good;
}

bool run(const Options &options) {
  const std::unique_ptr<host::Line> line = makeLine(options);
  mega::Mega mega(options.elf);
  mega::LineInput input(mega, *line);
  bool lineBegins = true;
  mega.onOutput([&](uint8_t byte) {
    if (lineBegins && options.frames) {
      std::fprintf(stderr, "frames since begin(): %lu\n", input.framesSinceOpen());
    }
    lineBegins = byte == '\n';
    std::putchar(byte);
  });

  const uint64_t endUs = static_cast<uint64_t>(options.seconds * 1e6);
  while (options.seconds > 0 ? mega.clockUs() < endUs : !line->finished(input.nowUs())) {
    mega.run();
  }
  report(input);
  return judge(mega, input, options);
}

}  // namespace

int main(int argc, char **argv) {
  try {
    return run(parseOptions(argc, argv)) && std::fflush(stdout) == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
  } catch (const std::exception &error) {
    std::fprintf(stderr, "%s\n", error.what());
    return EXIT_FAILURE;
  }
}
