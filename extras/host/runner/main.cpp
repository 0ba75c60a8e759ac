// Runs setup(), loop() and serialEventN() as the board's core does, with a line at one of the ports.

#include <fcntl.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <string>
#include <utility>

#include "Options.h"
#include "Uart.h"
#include "UsbSerial.h"
#include "board/Board.h"

void setup();
void loop();

// These are null in a sketch that does not define them.
void serialEvent() __attribute__((weak));
void serialEvent1() __attribute__((weak));
void serialEvent2() __attribute__((weak));
void serialEvent3() __attribute__((weak));

namespace {

using namespace host;

constexpr uint64_t HintUs = 3000000;  // after the start

volatile std::sig_atomic_t stopRequested = 0;

// The first Ctrl-C asks for the report; a second one ends the program even if the sketch hangs in a loop of its own.
void requestStop(int signal) {
  stopRequested = 1;
  std::signal(signal, SIG_DFL);
}

// Decides when the run is over, and ends it even if the sketch does not return from loop().
class Ending {
 public:
  Ending(const Options &options, const line::Line &line, const line::Line *second)
      : _options(options), _line(line), _second(second) {
    if (options.seconds > 0) {
      _endUs = static_cast<uint64_t>(options.seconds * 1e6);
    }
  }

  bool reached(uint64_t nowUs) const { return nowUs >= _endUs; }

  void check(uint64_t nowUs) {
    const bool hasFinished = _line.finished(nowUs) && (_second == nullptr || _second->finished(nowUs));
    if (!reached(nowUs) && (stopRequested != 0 || hasFinished || !_line.failure().empty())) {
      _endUs = nowUs;
    }
    if (reached(nowUs) && nowUs - _endUs >= PatienceUs) {
      std::fprintf(stderr, "setup() or loop() does not return: stopped inside it\n");
      end();
    }
  }

  [[noreturn]] void end() {
    Board &board = Board::instance();
    board.output().flush();
    printReport(board, _options);
    const std::string shared = _line.report();
    if (!shared.empty()) {
      std::fprintf(stderr, "%s\n", shared.c_str());
    }
    bool failed = complain(_line.failure());
    for (const SentOption &sent : _options.sent) {
      failed = complain(board.port(sent.port).sender().finish()) || failed;
    }
    std::exit(failed ? EXIT_FAILURE : EXIT_SUCCESS);
  }

 private:
  static constexpr uint64_t PatienceUs = 1000000;  // a sketch may stay in delay() for this long

  // Prints a failure. Returns true if there was one.
  static bool complain(const std::string &failure) {
    if (!failure.empty()) {
      std::fprintf(stderr, "%s\n", failure.c_str());
    }
    return !failure.empty();
  }

  const Options &_options;
  const line::Line &_line;
  const line::Line *const _second;  // null without one
  uint64_t _endUs = UINT64_MAX;
};

void runSerialEvents() {
  if (serialEvent && Serial.available() > 0) {
    serialEvent();
  }
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

// Makes standard input and output the sketch's Serial.
void prepareUsb(Board &board, const Options &options) {
  board.output().setLineByLine(!options.simulatedTime);
  board.input().setPatient(options.simulatedTime && isatty(STDIN_FILENO) == 0);
}

// Opens the files, before anything is printed: if one cannot be used, the only output is that message.
void prepareFiles(Board &board, const Options &options) {
  for (const SentOption &sent : options.sent) {
    board.port(sent.port).sender().record(std::make_unique<line::RecordingFile>(sent.file));
  }
}

void connectWires(Board &board, const Options &options) {
  for (const WireOption &wire : options.wires) {
    board.connect(wire.from, wire.to);
    std::fprintf(stderr, "Serial%d: its RX is wired to TX of Serial%d", wire.to, wire.from);
    if (options.on == 0 && options.seconds > 0) {
      std::fprintf(stderr, ", %g s; Ctrl-C stops it", options.seconds);
    }
    std::fputc('\n', stderr);
  }
}

// Says what may be wrong if a real port has brought no frames.
void hint(const line::Observer &observer, const std::string &port) {
  if (observer.characters() == 0) {
    std::fprintf(stderr,
                 "no bytes from %s yet. Is it the right port, the receiver powered and bound, S-BUS_OUT at RXD, GND at "
                 "GND?\n",
                 port.c_str());
  } else if (observer.counters().frames == 0) {
    std::fprintf(stderr, "no frames in the bytes from %s yet. Is the adapter's RXD inverted? See extras/docs/ftdi.md\n",
                 port.c_str());
  }
}

[[noreturn]] void run(const Options &options) {
  Board &board = Board::instance();
  prepareFiles(board, options);
  const std::unique_ptr<line::Line> line = makeLine(options), second = makeSecondLine(options);
  connectWires(board, options);
  if (options.pulses) {
    board.pulsePins().connect();
    std::fprintf(stderr, "pins 2..5: servo pulses of CH1..CH4, none while the radio is off\n");
  }
  prepareUsb(board, options);
  if (options.on != 0) {
    board.port(options.on).attach(*line, options.source.settings);
  }
  if (second) {
    board.port(SecondPort).attach(*second, options.second->settings);
  }
  Ending ending(options, *line, second.get());
  uint64_t hintUs = options.port.empty() ? UINT64_MAX : HintUs;
  board.onTime([&](uint64_t nowUs) {
    if (nowUs >= hintUs) {
      hintUs = UINT64_MAX;
      hint(board.port(options.on).observer(), options.port);
    }
    ending.check(nowUs);
  });
  board.setClock(Clock(options.simulatedTime ? Clock::Pace::Simulated : Clock::Pace::Real));

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
  if (fcntl(STDIN_FILENO, F_GETFD) < 0) {
    open("/dev/null", O_RDONLY);  // otherwise a file opened later would be taken for standard input
  }
  std::signal(SIGINT, requestStop);
  std::signal(SIGTERM, requestStop);
  std::signal(SIGTTIN, SIG_IGN);  // reading a terminal that belongs to another program then fails: see SketchInput
  std::signal(SIGPIPE, SIG_IGN);  // writing to a closed pipe then fails: see SketchOutput
  try {
    run(options);
  } catch (const std::exception &error) {
    std::fprintf(stderr, "%s\n", error.what());
    return EXIT_FAILURE;
  }
}
