// Prints the table of `sbus decode`: characters, or frames and discarded bytes.
#pragma once

#include <string>
#include <vector>

#include "cli/Output.h"
#include "line/Format.h"
#include "line/Observer.h"
#include "line/file/CaptureFile.h"

namespace tool {

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
    write("signal " + wire.signal() +
          (found.frames > 0 ? " carries S.Bus" : " has characters, but no frame of S.Bus") + others +
          (_isMeasured ? ": " + text(found.settings) + line::format(" (measured %.0f, %+.2f %%)", 1e9 / found.bitNs,
                                                                    100 * found.deviation())
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

  void frame(const line::Stretch &stretch, int64_t endNs, const line::Values &values) {
    const bool extra = stretch.kind == line::Stretch::Kind::Extra;
    const size_t from = extra ? 16 : 0;  // an extra frame has the channels after these
    const size_t to = stretch.kind == line::Stretch::Kind::Frame24 ? 24 : from + 16;
    std::string head = "\n     time ms";
    std::string row = line::format("%12.4f", ms(endNs));
    for (size_t i = from; i < to; i++) {
      head += line::format(" %5s", ("CH" + std::to_string(i + 1)).c_str());
      row += line::format(" %5u", values.raw[i]);
    }
    if (to == 16) {
      head += "  CH17 CH18";
      row += line::format("  %4d %4d", values.switches[0], values.switches[1]);
    }
    row += line::format("   %02X", stretch.characters.back().value);
    row += !extra && values.lostFrame ? "  lost frame" : "";
    row += !extra && values.failsafe ? "  failsafe" : "";
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
    if (!_isMeasured) {
      return std::string(character.parityWrong ? "parity error" : "") +
             (character.parityWrong && character.stopWrong ? "; " : "") + (character.stopWrong ? "framing error" : "");
    }
    // Levels of the wire, as an oscilloscope shows them.
    const int idle = _inverted ? 0 : 1;
    const int parity = line::isOdd(character.value) ? idle : 1 - idle;
    const std::string parityError =
        character.parityWrong
            ? line::format("parity error, the parity bit is %d on the wire, %d is expected", 1 - parity, parity)
            : "";
    const std::string framingError =
        character.stopWrong
            ? line::format("framing error, the first stop bit is %d on the wire, %d is expected", 1 - idle, idle)
            : "";
    return parityError + (character.parityWrong && character.stopWrong ? "; " : "") + framingError;
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

}  // namespace tool
