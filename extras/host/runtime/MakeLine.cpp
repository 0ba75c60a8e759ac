#include "MakeLine.h"

#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <utility>

#include "NoisyLine.h"
#include "RecordedLine.h"
#include "SerialPort.h"
#include "SilentLine.h"
#include "SimulatedReceiver.h"

namespace host {

namespace {

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

const char *what(Sticks sticks) {
  return sticks == Sticks::Flight
             ? "every 15 s: the sticks move, at 9.5 s the radio goes off, at 10.0 s failsafe, at 12.5 s it is back"
             : "every 40 s: whole travel; from 15 s let go, throttle low; from 23 s up and right; from 29 s a flight";
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
  std::fprintf(stderr, "Serial%d: simulated FrSky R-XSR, %g s; Ctrl-C stops it\n  %s\n", options.on, options.seconds,
               what(options.sticks));
  return std::make_unique<SimulatedReceiver>(choreography(options.sticks), wire.characterUs());
}

}  // namespace

Wire makeWire(const Options &options) {
  Wire wire;
  wire.baud = options.lineBaud;
  wire.polarity = !options.port.empty() ? Polarity::Either
                  : options.uninverted  ? Polarity::Uninverted
                                        : Polarity::Inverted;
  return wire;
}

std::unique_ptr<Line> makeLine(const Options &options, const Wire &wire) {
  if (options.on == 0) {
    return std::make_unique<SilentLine>();
  }
  std::unique_ptr<Line> line = makeQuietLine(options, wire);
  if (options.noise > 0) {
    line = std::make_unique<NoisyLine>(std::move(line), options.noise, wire.characterUs());
  }
  return line;
}

}  // namespace host
