#include "Options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <stdexcept>

#include "line/system/System.h"

namespace host {

namespace {

// Returns an error unless the text is 0.001 s to a year, which cannot overflow as microseconds. Rejects "nan".
std::string checkSeconds(const std::string &text) {
  constexpr double Largest = 366.0 * 24 * 60 * 60;
  char *end = nullptr;
  const double seconds = std::strtod(text.c_str(), &end);
  return *end == '\0' && seconds >= 0.001 && seconds <= Largest ? "" : "a number from 0.001 to 31622400 is expected";
}

bool isPort(char c) { return c >= '1' && c <= '3'; }

std::string checkWire(const std::string &text) {
  return text.size() == 3 && isPort(text[0]) && text[1] == '-' && isPort(text[2])
             ? ""
             : "\"" + text + "\": two ports such as 2-1 are expected, for a wire from TX2 to RX1";
}

std::string checkSent(const std::string &text) {
  return text.size() > 2 && isPort(text[0]) && text[1] == ':'
             ? ""
             : "\"" + text + "\": a port and a file's name such as 2:sent.txt are expected";
}

int portOf(char c) { return c - '0'; }

// A pin has one sender, and a file records one port.
void addWires(const std::vector<std::string> &texts, Options &options) {
  for (const std::string &text : texts) {
    const WireOption wire = {portOf(text[0]), portOf(text[2])};
    for (const WireOption &other : options.wires) {
      if (other.to == wire.to) {
        throw CLI::ValidationError("--wire", "two wires end at RX of Serial" + std::to_string(wire.to));
      }
    }
    options.wires.push_back(wire);
  }
}

void addSent(const std::vector<std::string> &texts, Options &options) {
  for (const std::string &text : texts) {
    const SentOption sent = {portOf(text[0]), text.substr(2)};
    if (sent.file == options.source.name) {
      throw CLI::ValidationError("--sent", "another file than that of --source is expected");
    }
    for (const SentOption &other : options.sent) {
      if (other.port == sent.port || other.file == sent.file) {
        throw CLI::ValidationError("--sent", "one file for each port, and one port for each file, is expected");
      }
    }
    options.sent.push_back(sent);
  }
}

void takeSource(const std::string &text, unsigned long baud, Options &options) {
  try {
    options.source = line::parseSource(text);
  } catch (const std::runtime_error &error) {
    throw CLI::ValidationError("--source", error.what());
  }
  options.source.settings.baud = baud;
  if (options.source.sbus2 && baud != sbus::Baud) {
    throw CLI::ValidationError("--baud", "S.BUS2 has 100000 baud; leave it out");
  }
  if (options.source.isSimulated() || !line::isPortName(options.source.name)) {
    return;
  }
  if (options.source.disturbs() || baud != sbus::Baud || options.pulses || options.simulatedTime) {
    throw CLI::ValidationError("--source", options.source.name + ": a port runs in real time at 100000 baud; leave " +
                                               (options.source.disturbs() ? "the words after the colon"
                                                : baud != sbus::Baud      ? "--baud"
                                                : options.pulses          ? "--pulses"
                                                                          : "--simulated-time") +
                                               " out");
  }
  options.port = options.source.name;
  options.source.settings.polarity = line::Polarity::Either;
}

// Takes the source of the line at Serial2, and rejects it if that port's RX has another one.
void takeSecond(const std::string &text, Options &options) {
  try {
    options.second = line::parseSource(text);
  } catch (const std::runtime_error &error) {
    throw CLI::ValidationError("--second", error.what());
  }
  if (!options.second->isSimulated() && line::isPortName(options.second->name)) {
    throw CLI::ValidationError("--second", text + ": a recording or sim is expected; give the port to --source");
  }
  options.second->settings.baud = options.source.settings.baud;
  const bool hasWire = std::any_of(options.wires.begin(), options.wires.end(),
                                   [](const WireOption &wire) { return wire.to == SecondPort; });
  if (hasWire || options.on == SecondPort) {
    throw CLI::ValidationError("--second", "RX of Serial2 has a --wire or the line of --on 2; leave that out");
  }
}

// Lets a wire at the RX pin of --on replace the line. Then there is no line, and its options are rejected.
void settleLine(const std::vector<CLI::Option *> &lineOptions, Options &options) {
  const bool taken = std::any_of(options.wires.begin(), options.wires.end(),
                                 [&options](const WireOption &wire) { return wire.to == options.on; });
  if (!taken) {
    return;
  }
  for (const CLI::Option *option : lineOptions) {
    if (option->count() > 0) {
      throw CLI::ValidationError(option->get_name(), "RX of Serial" + std::to_string(options.on) +
                                                         " has a --wire; attach the line to another port with --on");
    }
  }
  options.on = 0;
}

}  // namespace

Options parseOptions(int argc, char **argv) {
  Options options;
  std::vector<std::string> wires;
  std::vector<std::string> sent;
  std::string name = "sim";
  std::string secondName;
  unsigned long baudRate = sbus::Baud;
  CLI::App app{"Runs the sketch on this PC. Its Serial is standard output; everything else goes to standard error."};

  auto *source = app.add_option("--source", name,
                                "sim, sim:WORD,..., a recording (played once) or a serial port (until Ctrl-C); words: "
                                "24, 32, sbus2, silent, calibration; also of a recording: noise=N, uninverted (sim)");
  source->type_name("SOURCE");
  auto *baud = app.add_option("--baud", baudRate, "the line's baud rate (100000; Fast S.Bus: 200000)");
  baud->check(CLI::IsMember({100000, 200000}).description(""))->type_name("100000|200000");
  auto *on = app.add_option("--on", options.on, "the line is attached to Serial1, 2 or 3 (1)");
  on->check(CLI::Range(1, 3).description(""))->type_name("1|2|3");
  auto *second = app.add_option("--second", secondName, "a second receiver, at Serial2: sim:WORD,... or a recording");
  second->type_name("SOURCE");
  app.add_option("--wire", wires, "a wire from TX of one port to RX of another or the same; may be given several times")
      ->check(CLI::Validator(checkWire, ""))
      ->type_name("TX-RX")
      ->take_all()
      ->allow_extra_args(false);
  app.add_option("--sent", sent, "record what port N sends; may be given several times")
      ->check(CLI::Validator(checkSent, ""))
      ->type_name("N:FILE")
      ->take_all()
      ->allow_extra_args(false);
  app.add_flag("--pulses", options.pulses, "servo pulses at the pins 2..5, as from a receiver without S.Bus");
  app.add_option("--seconds", options.seconds, "end after this many seconds (default: 15; calibration: 40)")
      ->check(CLI::Validator(checkSeconds, ""))
      ->type_name("S");
  app.add_flag("--simulated-time", options.simulatedTime, "as fast as the PC can, exactly repeatable");
  app.add_option("--loop-us", options.loopUs, "what a call of loop() costs, in microseconds (50)")
      ->check(CLI::Range(1, 1000000).description(""))
      ->type_name("N");

  try {
    app.parse(argc, argv);
    takeSource(name, baudRate, options);
    addWires(wires, options);
    addSent(sent, options);
    settleLine({source, baud, on}, options);
    if (second->count() > 0) {
      takeSecond(secondName, options);
    }
  } catch (const CLI::ParseError &error) {
    std::exit(app.exit(error));
  }
  if (options.seconds == 0 && options.source.isSimulated() && options.port.empty()) {
    options.seconds = line::choreography(options.source.sticks).periodMs / 1000.0;  // one period
  }
  return options;
}

}  // namespace host
