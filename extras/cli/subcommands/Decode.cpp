// sbus decode: decodes the wire, as a logic analyser or an oscilloscope recorded it: characters, then frames.

#include <csignal>
#include <deque>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include "cli/DecodeTable.h"
#include "cli/FileSource.h"
#include "cli/Output.h"
#include "cli/PendingSlots.h"
#include "cli/Pipe.h"
#include "cli/TextLine.h"
#include "cli/options/PartOption.h"
#include "cli/options/Subcommand.h"
#include "cli/subcommands/Subcommands.h"
#include "line/capture/RecordedCapture.h"
#include "line/recording/RecordingWriter.h"
#include "line/system/System.h"

namespace tool {

namespace {

struct Options {
  std::string capture;
  std::string output;  // a recording
  line::Overrides overrides;
  PartOption part;
  bool characters = false;
};

// Passes the wire's characters to the Observer, with times from 0, and receives stretches from it.
class Frames {
 public:
  // `record` receives the text of a recording; without it the frames go to `output`.
  Frames(DecodeTable &output, Put record) : _output(output), _record(std::move(record)) {
    _observer.listen([this](const line::Stretch &stretch) { _held.take(stretch); });
  }

  void begin(const std::string &capture, const line::FoundWire &wire) {
    _times.begin(wire);
    _observer.reset(0, wire.settings.characterUs());
    _writer.comment("sbus decode " + capture);
    _writer.opened(wire.settings);
  }

  void put(const line::WireCharacter &wire) {
    _waiting.push_back(wire);
    const line::Character character = _times.of(wire);
    _observer.put(character);
    if (_record) {
      _writer.setZero(_times.zeroNs() / 1000);
      _writer.put(character);
      _record(_writer.take());
    }
  }

  const line::Observer &finish(int64_t endNs) {
    _observer.idleUntil(_times.us(endNs));
    _observer.finish();
    _held.finish();
    if (_record) {
      _writer.finish();
      _record(_writer.take());
    }
    return _observer;
  }

 private:
  void take(const line::Stretch &stretch) {
    const auto end = _waiting.begin() + static_cast<std::ptrdiff_t>(stretch.characters.size());
    const std::vector<line::WireCharacter> characters(_waiting.begin(), end);
    _waiting.erase(_waiting.begin(), end);
    if (!_record) {
      _output.stretch(stretch, characters, _observer.newest());
    }
  }

  DecodeTable &_output;
  const Put _record;
  line::RecordingWriter _writer;
  line::Observer _observer;
  PendingSlots _held{_observer, [this](const line::Stretch &stretch) { take(stretch); }};
  std::deque<line::WireCharacter> _waiting;  // not in a stretch yet
  line::CaptureTimes _times;
};

std::string whyNoFrame(const line::WireDecoder &wire, unsigned long characters) {
  return "signal " + wire.signal() + " has " + std::to_string(characters) + " characters" +
         (wire.isMeasured() ? " at " + text(wire.wire().settings) : "") + ", but no frame of S.Bus: " + line::FrameForm;
}

void decode(const Options &options, const Put &record) {
  line::onStop(SIG_DFL);  // Ctrl-C ends it at once, even while it waits for standard input: no file is left half done
  if (options.capture == "-") {
    setLineByLine();
  } else if (!Pipe::isPipe(options.capture)) {
    const FileSource head = readHead(options.capture);
    const std::string other = line::whyNoCapture(head.kind, head.begin);
    if (!other.empty()) {
      throw std::runtime_error(options.capture + ": " + other);
    }
  }
  DecodeTable output(options.characters);
  std::optional<int64_t> firstUs;  // of all characters
  int64_t lastUs = 0;
  bool any = false;  // in the part
  Frames frames(output, record);
  line::WireDecoder wire(
      options.overrides,
      [&] {
        output.begin(wire);
        frames.begin(options.capture, wire.wire());
      },
      [&](const line::WireCharacter &character) {
        lastUs = (character.startNs + output.characterNs()) / 1000;
        firstUs = firstUs.value_or(lastUs);
        if (!options.part.has(lastUs)) {
          return;
        }
        any = true;
        output.character(character);
        frames.put(character);
      });
  const line::CaptureEnd capture = readCapture(options.capture, options.capture, options.overrides, wire);
  if (!wire.found()) {
    throw std::runtime_error(capture.error.empty() ? options.capture + ": " + wire.failure(capture.periodNs)
                                                   : capture.error);
  }
  if (firstUs && !any) {
    throw std::runtime_error(options.capture + emptyPart(*firstUs, lastUs));
  }
  const line::Observer &observer = frames.finish(wire.endNs());
  output.end(options.capture, capture, observer);
  flush();
  if (!capture.error.empty()) {
    throw std::runtime_error(capture.error + "; the part before it is " +
                             (options.output.empty() ? "decoded above" : "in " + options.output));
  }
  const std::string slow = line::tooSlow(capture.periodNs, wire.wire().bitNs);
  if (!slow.empty()) {
    throw std::runtime_error(options.capture + ": " + slow + ". What could be decoded is above");
  }
  if (observer.counters().frames == 0 && !options.characters) {
    throw std::runtime_error(options.capture + ": " + whyNoFrame(wire, observer.characters()));
  }
}

void run(const Options &options) {
  if (options.output.empty()) {
    decode(options, Put());
    return;
  }
  rejectSameFile(options.capture, options.output);
  writeTo(options.output, File::New, [&](const Put &put) { decode(options, put); });
}

}  // namespace

void addDecode(CLI::App &app) {
  Subcommand subcommand(app, "decode", "decodes the wire as a logic analyser or an oscilloscope recorded it");
  const auto options = std::make_shared<Options>();
  subcommand
      .option("CAPTURE", options->capture,
              "VCD; session of PulseView (.sr); CSV of Saleae Logic 2, PulseView, DSView or an oscilloscope; "
              "table of Saleae's Async Serial; "
              "each also packed (.gz, .xz, .zip); - is standard input")
      .required()
      .notEmpty()
      .type("");
  subcommand
      .option("-o,--output", options->output,
              "write a recording instead of the table; an existing file is not overwritten")
      .notStandardOutput()
      .type("FILE.txt");
  line::Overrides &overrides = options->overrides;
  subcommand.option("--signal", overrides.signal, "decode only this signal (the one with the most frames)")
      .type("NAME");
  options->part.addTo(subcommand);
  subcommand.option("--baud", overrides.baud, "the wire's baud rate, within 3 % (100000 or 200000)")
      .between(50000, 400000)
      .type("N");
  subcommand
      .option(
          "--sample-rate", [&overrides](double hertz) { overrides.periodNs = 1e9 / hertz; },
          "samples a second; each row or bit is one sample (as the capture says)")
      .between(1, 1e10)
      .type("HZ");
  subcommand
      .option(
          "--threshold", [&overrides](double volts) { overrides.threshold = volts; },
          "the voltage above which the wire is high, in the capture's unit (detected)")
      .type("V");
  subcommand.flag("--characters", options->characters, "print the characters, not the frames");
  subcommand.footer(
      "Decode finds the signal, its polarity, its baud rate (100000 or 200000) and an oscilloscope's threshold, "
      "unless options name them. Times are the capture's: the end of a frame's last byte, or the first edge of a "
      "character. It exits with 1 if there is no frame. For programs, hex --json and csv print a capture's frames.");
  subcommand.run([options] { run(*options); });
}

}  // namespace tool
