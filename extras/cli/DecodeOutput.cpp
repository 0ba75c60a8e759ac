#include "cli/DecodeOutput.h"

#include "cli/Json.h"
#include "cli/Output.h"
#include "line/Format.h"
#include "line/FrameBytes.h"

namespace tool {

namespace {

std::string hex(uint8_t byte) {
  return line::format("%02X", byte);
}

double ms(int64_t ns) {
  return static_cast<double>(ns) / 1e6;
}

// Rounds to a tenth of a microsecond: samples are rarely shorter.
std::string us(int64_t ns) {
  return line::format("%.1f", static_cast<double>(ns) / 1e3);
}

}  // namespace

void DecodeOutput::begin(const line::WireDecoder &wire) {
  const line::FoundWire &found = wire.wire();
  _isMeasured = wire.isMeasured();
  _inverted = found.settings.polarity == line::Polarity::Inverted;
  _channels = found.channels;
  _characterNs = static_cast<int64_t>(found.settings.format.bits() * found.bitNs);
  const double measured = 1e9 / found.bitNs;
  switch (_form) {
    case Form::Table: {
      std::string others;
      for (const std::string &name : wire.others()) {
        others += (others.empty() ? ", as does " : ", ") + name;
      }
      write("signal " + wire.signal() +
            (found.frames > 0 ? " carries S.Bus" : " has characters, but no frame of S.Bus") + others +
            (_isMeasured ? ": " + text(found.settings) +
                               line::format(" (measured %.0f, %+.2f %%)", measured, 100 * found.deviation())
                         : ", as decoded by the analyser") +
            '\n');
      if (_showsCharacters) {
        write("\n     time ms  byte\n");
      }
      break;
    }
    case Form::Csv:
      if (_showsCharacters) {
        write("time_us,byte,parity_error,framing_error\n");
      } else {
        csvHead();
      }
      break;
    case Form::Json: {
      JsonLine line;
      line.source = _source;
      line.signal = wire.signal();
      if (_isMeasured) {
        line.baud = found.settings.baud;
        line.inverted = _inverted;
      }
      Json json = lineJson(line).range(_channelForm);
      write((_isMeasured ? json.number("measured_baud", static_cast<uint64_t>(measured + 0.5)) : json).line());
    }
  }
}

void DecodeOutput::character(const line::WireCharacter &character) {
  _characters++;
  _parityErrors += character.parityWrong;
  _framingErrors += character.stopWrong;
  if (!_showsCharacters) {
    return;
  }
  const std::string byte = hex(character.value);
  switch (_form) {
    case Form::Table:
      write(line::format("%12.4f  ", ms(character.startNs)) + byte + (character.bad() ? "  " + fault(character) : "") +
            '\n');
      break;
    case Form::Csv:
      write(us(character.startNs) + "," + byte + line::format(",%d,%d\n", character.parityWrong, character.stopWrong));
      break;
    case Form::Json:
      write(Json("character")
                .decimal("time_us", static_cast<double>(character.startNs) / 1e3)
                .text("byte", byte)
                .flag("parity_error", character.parityWrong)
                .flag("framing_error", character.stopWrong)
                .line());
  }
}

void DecodeOutput::stretch(const line::Stretch &stretch, const std::vector<line::WireCharacter> &characters,
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

void DecodeOutput::frame(const line::Stretch &stretch, int64_t endNs, const line::Values &values) {
  const bool extra = stretch.kind == line::Stretch::Kind::Extra;
  const size_t from = extra ? 16 : 0;  // an extra frame has the channels after these
  const size_t to = stretch.kind == line::Stretch::Kind::Frame24 ? 24 : from + 16;
  const std::string end = hex(stretch.characters.back().value);
  const bool newHead = _columns != to;
  _columns = to;
  switch (_form) {
    case Form::Table: {
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
      row += "   " + end +
             (extra              ? ""
              : values.lostFrame ? "  lost frame"
                                 : "") +
             (extra             ? ""
              : values.failsafe ? "  Failsafe"
                                : "");
      write((newHead ? head + "  end\n" : "") + row + '\n');
      break;
    }
    case Form::Csv:
      csvRow(stretch, endNs, values);
      break;
    case Form::Json:
      write(frameJson(stretch, static_cast<double>(endNs) / 1e3, values, _channelForm).line());
  }
}

// Writes one header for all rows, as a spreadsheet expects it.
void DecodeOutput::csvHead() {
  std::string head = "time_us";
  for (unsigned i = 1; i <= _channels; i++) {
    head += ",CH" + std::to_string(i);
  }
  head += _channels == 16 ? ",CH17,CH18" : _channels == 32 ? ",DG1,DG2" : "";
  write(head + ",lost_frame,failsafe,end\n");
}

// Writes a row. Fields that the frame does not carry stay empty: each frame has half of 32 channels.
void DecodeOutput::csvRow(const line::Stretch &stretch, int64_t endNs, const line::Values &values) {
  const bool extra = stretch.kind == line::Stretch::Kind::Extra;
  if ((stretch.kind == line::Stretch::Kind::Frame24) != (_channels == 24) || (extra && _channels != 32)) {
    _leftOut++;
    return;
  }
  const unsigned from = extra ? 16 : 0;
  const unsigned to = _channels == 24 ? 24 : from + 16;
  std::string row = us(endNs);
  for (unsigned i = 0; i < _channels; i++) {
    row += i >= from && i < to ? "," + std::to_string(values.raw[i]) : ",";
  }
  const line::Values own = extra ? line::withFlags(values, stretch.characters[sbus::FlagsIndex].value) : values;
  row += _channels == 24 ? "" : line::format(",%d,%d", own.switches[0], own.switches[1]);
  row += line::format(",%d,%d,", own.lostFrame, own.failsafe);
  write(row + hex(stretch.characters.back().value) + '\n');
}

void DecodeOutput::noFrame(const line::Stretch &stretch, const std::vector<line::WireCharacter> &characters) {
  std::string bytes;
  for (const line::WireCharacter &character : characters) {
    bytes += (bytes.empty() ? "" : " ") + hex(character.value) + (character.bad() ? "!" : "");
  }
  const int64_t endNs = this->endNs(characters.back());
  if (_form == Form::Json && !stretch.slots.empty()) {
    const auto startUs = static_cast<int64_t>(endNs / 1000) - static_cast<int64_t>(stretch.endUs());
    for (const line::TimedSlot &slot : stretch.slots) {
      write(slotJson(slot, static_cast<double>(startUs + static_cast<int64_t>(slot.endUs))).line());
    }
  } else if (_form == Form::Json) {
    write(noFrameJson(stretch, static_cast<double>(endNs) / 1e3).line());
  }
  if (_form != Form::Table) {
    return;
  }
  write(line::format("%12.4f ", ms(endNs)) + "no frame, " + why(stretch) + ": " + bytes + '\n');
  for (size_t i = 0; i < characters.size(); i++) {
    if (characters[i].bad()) {
      write(line::format("%12.4f     ", ms(characters[i].startNs)) + "byte " + std::to_string(i) + ", " +
            hex(characters[i].value) + ": " + fault(characters[i]) + '\n');
    }
  }
}

std::string DecodeOutput::fault(const line::WireCharacter &character) const {
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
  return parityError + (character.bad() && character.parityWrong && character.stopWrong ? "; " : "") + framingError;
}

void DecodeOutput::end(const std::string &name, const line::CaptureEnd &capture, const line::Observer &observer) const {
  const sbus::Counters &counters = observer.counters();
  switch (_form) {
    case Form::Table:
      write("\n" + name + ", " + capture.format + ": " + std::to_string(_characters) + " characters, " +
            std::to_string(_parityErrors) + " parity errors, " + std::to_string(_framingErrors) + " framing errors; " +
            std::to_string(counters.frames) + " frames, " + std::to_string(counters.lostFrames) + " lost, " +
            std::to_string(counters.failsafeFrames) + " in failsafe" +
            (counters.frames > 1 ? line::format(", every %.2f ms", static_cast<double>(observer.gaps().mean()) / 1000)
                                 : "") +
            '\n');
      break;
    case Form::Csv:
      break;
    case Form::Json:
      write(Json("end")
                .number("characters", _characters)
                .number("parity_errors", _parityErrors)
                .number("framing_errors", _framingErrors)
                .counts(counters)
                .line());
  }
}

}  // namespace tool
