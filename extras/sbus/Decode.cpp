// sbus decode: a logic analyser's or an oscilloscope's recording of the wire itself; characters, then frames.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <deque>
#include <memory>
#include <stdexcept>

#include "DecodeOutput.h"
#include "LineOptions.h"
#include "Output.h"
#include "Subcommands.h"

namespace tool {

namespace {

struct Options {
  std::string capture;
  std::string signal;
  bool csv = false;
  bool json = false;
  bool characters = false;
};

// Hands the characters of the wire over to the Observer, whose times begin at 0, and gets them back in stretches.
class Frames {
 public:
  explicit Frames(DecodeOutput &output) : _output(output) {
    _observer.listen([this](const line::Stretch &stretch) { take(stretch); });
  }

  void begin(const line::FoundWire &wire) {
    _characterNs = wire.settings.format.bits() * wire.bitNs;
    _observer.reset(0, wire.settings.characterUs());
  }

  void put(const line::WireCharacter &wire) {
    if (_waiting.empty() && _observer.characters() == 0) {
      _zeroNs = std::min<int64_t>(0, wire.startNs);
    }
    _waiting.push_back(wire);
    line::Character character;
    character.endUs = static_cast<uint64_t>((static_cast<double>(wire.startNs - _zeroNs) + _characterNs) / 1000);
    character.value = wire.value;
    character.bad = wire.bad();
    _observer.put(character);
  }

  const line::Observer &finish() {
    _observer.finish();
    return _observer;
  }

 private:
  void take(const line::Stretch &stretch) {
    const auto end = _waiting.begin() + static_cast<std::ptrdiff_t>(stretch.characters.size());
    const std::vector<line::WireCharacter> characters(_waiting.begin(), end);
    _waiting.erase(_waiting.begin(), end);
    _output.stretch(stretch, characters, _observer.newest());
  }

  DecodeOutput &_output;
  line::Observer _observer;
  std::deque<line::WireCharacter> _waiting;  // in no stretch yet
  double _characterNs = 0;
  int64_t _zeroNs = 0;
};

void run(const Options &options) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    std::signal(signal, SIG_DFL);  // it waits for standard input, and leaves nothing behind
  }
  DecodeOutput output(options.json ? Form::Json : options.csv ? Form::Csv : Form::Table, options.characters);
  Frames frames(output);
  line::WireDecoder wire(
      options.signal,
      [&] {
        output.begin(wire);
        frames.begin(wire.wire());
      },
      [&](const line::WireCharacter &character) {
        output.character(character);
        frames.put(character);
      });
  const line::CaptureEnd capture = readCapture(options.capture, wire);
  if (!wire.found()) {
    throw std::runtime_error(capture.error.empty() ? options.capture + ": " + wire.failure(capture.periodNs)
                                                   : capture.error);
  }
  output.end(options.capture, capture, frames.finish());
  flush();
  if (!capture.error.empty()) {
    throw std::runtime_error(capture.error + "; what came before it is decoded above");
  }
  const std::string slow = line::tooSlow(capture.periodNs, wire.wire().bitNs);
  if (!slow.empty()) {
    throw std::runtime_error(options.capture + ": " + slow + ". What could be decoded is above");
  }
}

}  // namespace

void addDecode(CLI::App &app) {
  CLI::App *const subcommand = app.add_subcommand("decode", "a logic analyser's or oscilloscope's recording of the wire");
  const auto options = std::make_shared<Options>();
  subcommand->add_option("CAPTURE", options->capture,
                   "VCD; CSV of Saleae Logic 2, PulseView or an oscilloscope; bits as 0 and 1; - is standard input")
      ->required()
      ->check(notEmpty())
      ->type_name("");
  subcommand->add_option("--signal", options->signal, "the only one to be looked at (the one that carries S.Bus)")
      ->type_name("NAME");
  const auto csv = subcommand->add_flag("--csv", options->csv, "rows for a spreadsheet");
  subcommand->add_flag("--json", options->json, "JSON lines")->excludes(csv);
  subcommand->add_flag("--characters", options->characters, "the characters, not the frames");
  subcommand->footer(
      "Polarity, baud rate (100000 or 200000) and an oscilloscope's threshold are found by themselves. Times are the "
      "capture's: of the first start bit's edge.");
  subcommand->callback([options] { run(*options); });
}

}  // namespace tool
