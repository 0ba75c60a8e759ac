// Runs setup(), loop() and serialEventN() as the board's core does, with a line at one of the ports.

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <utility>

#include "Board.h"
#include "NoisyLine.h"
#include "Options.h"
#include "RecordedLine.h"
#include "Report.h"
#include "SerialPort.h"
#include "SilentLine.h"
#include "SimulatedReceiver.h"
#include "Uart.h"

void setup();
void loop();

// A sketch has those that it defines.
void serialEvent1() __attribute__((weak));
void serialEvent2() __attribute__((weak));
void serialEvent3() __attribute__((weak));

namespace {

using namespace host;

volatile std::sig_atomic_t stopRequested = 0;

// The first Ctrl-C asks for the report; a second one ends the program even if the sketch hangs in a loop of its own.
void requestStop(int signal) {
  stopRequested = 1;
  std::signal(signal, SIG_DFL);
}

RecordedLine openRecording(const std::string &file, uint32_t characterUs) {
  std::ifstream in(file, std::ios::binary);
  if (!in) {
    throw std::runtime_error(file + ": cannot be opened; the name of a recording is expected");
  }
  Recording recording = parseRecording(in, characterUs);
  if (!recording.error.empty()) {
    const std::string place = recording.errorLine > 0 ? ":" + std::to_string(recording.errorLine) : "";
    throw std::runtime_error(file + place + ": " + recording.error);
  }
  return RecordedLine(std::move(recording));
}

Wire makeWire(const Options &options) {
  Wire wire;
  wire.baud = options.lineBaud;
  wire.polarity = !options.port.empty()  ? Polarity::Either
                  : options.uninverted   ? Polarity::Uninverted
                                         : Polarity::Inverted;
  return wire;
}

// Makes the line that the options ask for, and says which one it is.
std::unique_ptr<Line> makeQuietLine(const Options &options, const Wire &wire) {
  const char *const until = options.seconds > 0 ? "" : ", until Ctrl-C";
  if (!options.port.empty()) {
    auto line = std::make_unique<SerialPort>(options.port);
    std::fprintf(stderr, "Serial%d: receiver at %s, 100000 baud, 8E2%s\n", options.on, options.port.c_str(), until);
    return line;
  }
  if (!options.recording.empty()) {
    auto line = std::make_unique<RecordedLine>(openRecording(options.recording, wire.characterUs()));
    std::fprintf(stderr, "Serial%d: recording %s, once; Ctrl-C stops it\n", options.on, options.recording.c_str());
    return line;
  }
  if (options.silent) {
    std::fprintf(stderr, "Serial%d: a wire with nothing on it, %g s; Ctrl-C stops it\n", options.on, options.seconds);
    return std::make_unique<SilentLine>();
  }
  std::fprintf(stderr,
               "Serial%d: simulated FrSky R-XSR, %g s; Ctrl-C stops it\n"
               "  every 15 s: the sticks move, at 9.5 s the radio goes off, at 10.0 s failsafe, at 12.5 s it is back\n",
               options.on, options.seconds);
  return std::make_unique<SimulatedReceiver>(wire.characterUs());
}

std::unique_ptr<Line> makeLine(const Options &options, const Wire &wire) {
  std::unique_ptr<Line> line = makeQuietLine(options, wire);
  if (options.noise > 0) {
    line = std::make_unique<NoisyLine>(std::move(line), options.noise, wire.characterUs());
  }
  return line;
}

// Decides when the run is over, and sees to it that it ends even if the sketch does not come back from loop().
class Ending {
 public:
  Ending(const Options &options, const Line &line) : _line(line), _on(options.on) {
    if (options.seconds > 0) {
      _endUs = static_cast<uint64_t>(options.seconds * 1e6);
    }
  }

  bool reached(uint64_t nowUs) const { return nowUs >= _endUs; }

  void look(uint64_t nowUs) {
    if (!reached(nowUs) && (stopRequested != 0 || _line.finished(nowUs) || !_line.failure().empty())) {
      _endUs = nowUs;
    }
    if (reached(nowUs) && nowUs - _endUs >= PatienceUs) {
      std::fprintf(stderr, "setup() or loop() does not return: stopped inside it\n");
      end();
    }
  }

  [[noreturn]] void end() {
    Board::instance().output().flush();
    printReport(Board::instance(), _on);
    if (!_line.failure().empty()) {
      std::fprintf(stderr, "%s\n", _line.failure().c_str());
    }
    std::exit(_line.failure().empty() ? EXIT_SUCCESS : EXIT_FAILURE);
  }

 private:
  static constexpr uint64_t PatienceUs = 1000000;  // a sketch may stay in delay() for as long

  const Line &_line;
  int _on;
  uint64_t _endUs = UINT64_MAX;
};

void runSerialEvents() {
  if (serialEvent1 && Serial1.available() > 0) {
    serialEvent1();
  }
  if (serialEvent2 && Serial2.available() > 0) {
    serialEvent2();
  }
  if (serialEvent3 && Serial3.available() > 0) {
    serialEvent3();
  }
}

[[noreturn]] void run(const Options &options) {
  const Wire wire = makeWire(options);
  const std::unique_ptr<Line> line = makeLine(options, wire);
  Board &board = Board::instance();
  board.output().setLineByLine(!options.simulatedTime);
  if (options.pty) {
    auto terminal = std::make_unique<PseudoTerminal>();
    std::fprintf(stderr, "Serial (USB) is on %s as well\n", terminal->name().c_str());
    board.output().attach(std::move(terminal));
  }
  board.port(options.on).attach(*line, wire);
  Ending ending(options, *line);
  board.onTime([&ending](uint64_t nowUs) { ending.look(nowUs); });
  board.setClock(Clock(options.simulatedTime ? Clock::Pace::Simulated : Clock::Pace::Real, options.startMs));

  setup();
  while (!ending.reached(board.clock().nowUs())) {
    loop();
    runSerialEvents();
    board.spend(options.loopUs);
  }
  ending.end();
}

}  // namespace

int main(int argc, char **argv) {
  const Options options = parseOptions(argc, argv);
  std::signal(SIGINT, requestStop);
  std::signal(SIGTERM, requestStop);
  std::signal(SIGPIPE, SIG_IGN);  // writing to a closed pipe then fails, and SketchOutput sees to it
  try {
    run(options);
  } catch (const std::exception &error) {
    std::fprintf(stderr, "%s\n", error.what());
    return EXIT_FAILURE;
  }
}
