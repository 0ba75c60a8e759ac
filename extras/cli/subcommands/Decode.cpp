// sbus decode: decodes the wire, as a logic analyser or an oscilloscope recorded it: characters, then frames.

#include <csignal>
#include <deque>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "cli/FileSource.h"
#include "cli/Output.h"
#include "cli/PendingSlots.h"
#include "cli/Pipe.h"
#include "cli/TextLine.h"
#include "cli/options/PartOption.h"
#include "cli/options/Subcommand.h"
#include "cli/subcommands/Subcommands.h"
#include "line/Format.h"
#include "line/Observer.h"
#include "line/capture/RecordedCapture.h"
#include "line/file/CaptureFile.h"
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

// Prints the table: characters, or frames and discarded bytes.
class DecodeTable {
 public:
  // Shows each character if `characters` is true; otherwise frames, and the discarded bytes.
  explicit DecodeTable(bool characters) : _showsCharacters(characters) {}

  // Takes the wire, once it has been found.
  void begin(const line::WireDecoder &wire) {
    const line::FoundWire &found = wire.wire();
    _isMeasured = wire.isMeasured();
    _inverted = found.settings.polarity == line::Polarity::Inverted;
    _characterNs = static_cast<int64_t>(found.settings.format.bits() * found.bitNs);
    std::string others;
    for (const std::string &name : wire.others()) {
      others += (others.empty() ? ", as does " : ", ") + name;
    }
    write("signal " + wire.signal() + (found.frames > 0 ? " carries S.Bus" : " has characters, but no frame of S.Bus") +
          others +
          (_isMeasured ? ": " + text(found.settings) +
                             line::format(" (measured %.0f, %+.2f %%)", 1e9 / found.bitNs, 100 * found.deviation())
                       : ", as decoded by the analyser") +
          (_showsCharacters ? "\n\n     time ms  byte\n" : "\n"));
  }

  void character(const line::WireCharacter &character) {
    _characters++;
    _parityErrors += character.parityWrong;
    _framingErrors += character.stopWrong;
    if (_showsCharacters) {
      write(line::format("%12.4f  %02X", ms(character.startNs), character.value) +
            (character.bad() ? "  " + fault(character) : "") + '\n');
    }
  }

  // Takes a stretch of the line with its characters as they were on the wire. `values`: the frame's, if it is one.
  void stretch(const line::Stretch &stretch, const std::vector<line::WireCharacter> &characters,
               const line::Values &values) {
    if (_showsCharacters) {
      return;
    }
    if (stretch.isFrame()) {
      frame(stretch, endNs(characters.back()), values);
    } else {
      noFrame(stretch, characters);
    }
  }

  // Returns how long a character takes, once the wire is found.
  int64_t characterNs() const { return _characterNs; }

  void end(const std::string &name, const line::CaptureEnd &capture, const line::Observer &observer) const {
    const sbus::Counters &counters = observer.counters();
    write("\n" + name + ", " + capture.format +
          line::format(": %lu characters, %lu parity errors, %lu framing errors; %lu frames, %lu lost, %lu in failsafe",
                       _characters, _parityErrors, _framingErrors, static_cast<unsigned long>(counters.frames),
                       static_cast<unsigned long>(counters.lostFrames),
                       static_cast<unsigned long>(counters.failsafeFrames)) +
          (counters.frames > 1 ? line::format(", every %.2f ms", static_cast<double>(observer.gaps().mean()) / 1000)
                               : "") +
          '\n');
  }

 private:
  static double ms(int64_t ns) { return static_cast<double>(ns) / 1e6; }
  int64_t endNs(const line::WireCharacter &character) const { return character.startNs + _characterNs; }

  void frame(const line::Stretch &stretch, int64_t endNs, const line::Values &newest) {
    const bool extra = stretch.kind == line::Stretch::Kind::Extra;
    const line::Values values = extra ? line::withFlags(newest, stretch.characters[sbus::FlagsIndex].value) : newest;
    const size_t from = extra ? 16 : 0;  // an extra frame has the channels after these
    const size_t to = stretch.kind == line::Stretch::Kind::Frame24 ? 24 : from + 16;
    std::string head = "\n     time ms";
    std::string row = line::format("%12.4f", ms(endNs));
    for (size_t i = from; i < to; i++) {
      head += line::format(" %5s", ("CH" + std::to_string(i + 1)).c_str());
      row += line::format(" %5u", values.raw[i]);
    }
    if (to != 24) {
      head += extra ? "   DG1  DG2" : "  CH17 CH18";
      row += line::format("  %4d %4d", values.switches[0], values.switches[1]);
    }
    row += line::format("   %02X", stretch.characters.back().value);
    row += values.lostFrame ? "  lost frame" : "";
    row += values.failsafe ? "  failsafe" : "";
    write((_columns != to ? head + "  end\n" : "") + row + '\n');
    _columns = to;
  }

  void noFrame(const line::Stretch &stretch, const std::vector<line::WireCharacter> &characters) {
    std::string bytes;
    for (const line::WireCharacter &character : characters) {
      bytes += line::format(" %02X%s", character.value, character.bad() ? "!" : "");
    }
    write(line::format("%12.4f no frame, ", ms(endNs(characters.back()))) + why(stretch) + ":" + bytes + '\n');
    for (size_t i = 0; i < characters.size(); i++) {
      if (characters[i].bad()) {
        write(line::format("%12.4f     byte %zu, %02X: ", ms(characters[i].startNs), i, characters[i].value) +
              fault(characters[i]) + '\n');
      }
    }
  }

  // Returns "parity error, the parity bit is 1 on the wire, 0 is expected".
  std::string fault(const line::WireCharacter &character) const {
    // Levels of the wire, as an oscilloscope shows them.
    const int idle = _inverted ? 0 : 1;
    const int parity = line::isOdd(character.value) ? idle : 1 - idle;
    const auto error = [this](bool is, const char *name, const char *bit, int level) {
      return !is ? ""
                 : name + (_isMeasured
                               ? line::format(", the %s bit is %d on the wire, %d is expected", bit, 1 - level, level)
                               : "");
    };
    return error(character.parityWrong, "parity error", "parity", parity) +
           (character.parityWrong && character.stopWrong ? "; " : "") +
           error(character.stopWrong, "framing error", "first stop", idle);
  }

  const bool _showsCharacters;
  bool _isMeasured = true;  // the capture holds the wire, not characters decoded by an analyser
  bool _inverted = true;
  int64_t _characterNs = 0;
  size_t _columns = 0;  // of the newest frame: a change starts a new heading
  unsigned long _characters = 0;
  unsigned long _parityErrors = 0;
  unsigned long _framingErrors = 0;
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
  if (!wire.note().empty()) {
    std::fprintf(stderr, "%s: %s\n", options.capture.c_str(), wire.note().c_str());
  }
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
    if (const sbus::Finding other = observer.otherProtocol(); other != sbus::Finding::NoSignal) {
      throw std::runtime_error(options.capture + ": signal " + wire.signal() + ": " + std::string(sbus::text(other)) +
                               " " + std::string(sbus::remedy(other)));
    }
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
              "a capture by a logic analyser or an oscilloscope, as CSV, VCD or PulseView's .sr; - is standard input")
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
          "samples a second; each row is one sample (as the capture says)")
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
