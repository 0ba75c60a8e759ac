#include "Options.h"

#include <cstdio>
#include <utility>

#include "line/ports/SerialPort.h"
#include "line/recording/RestoredLine.h"
#include "line/Line.h"

namespace host {

namespace {

const char *what(line::Sticks sticks) {
  return sticks == line::Sticks::Flight
             ? "every 15 s: the sticks move, at 9.5 s the radio goes off, at 10.0 s failsafe, at 12.5 s it is back"
             : "every 40 s: whole travel; from 15 s let go, throttle low; from 23 s up and right; from 29 s a flight";
}

// Opens a recording or a simulated receiver for a port, and prints its name.
std::unique_ptr<line::Line> openLine(line::Source source, int port, double seconds) {
  source.isForSketch = true;
  std::unique_ptr<line::Line> line = source.open();
  std::fprintf(stderr, "Serial%d: %s", port, source.text().c_str());
  if (seconds > 0 && source.isSimulated()) {
    std::fprintf(stderr, ", %g s; Ctrl-C stops it\n", seconds);
  } else {
    std::fprintf(stderr, "; Ctrl-C stops it\n");
  }
  if (source.isSimulated() && !source.silent) {
    std::fprintf(stderr, "  %s\n", what(source.sticks));
  }
  return line;
}

}  // namespace

std::unique_ptr<line::Line> makeLine(const Options &options) {
  if (options.on == 0) {
    return std::make_unique<line::SilentLine>();
  }
  if (!options.port.empty()) {
    auto port = std::make_unique<line::SerialPort>(options.port);
    auto line = std::make_unique<line::RestoredLine>(std::move(port), line::CharacterUs);
    std::fprintf(stderr, "Serial%d: receiver at %s, 100000 baud, 8E2%s\n", options.on, options.port.c_str(),
                 options.seconds > 0 ? "" : ", until Ctrl-C");
    return line;
  }
  return openLine(options.source, options.on, options.seconds);
}

std::unique_ptr<line::Line> makeSecondLine(const Options &options) {
  return options.second ? openLine(*options.second, SecondPort, options.seconds) : nullptr;
}

}  // namespace host
