// sbus explain: prints the paper's tables for one frame: its bytes with their meaning, its channels with their bits.

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <iterator>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "cli/Output.h"
#include "cli/options/Subcommand.h"
#include "cli/subcommands/Subcommands.h"
#include "line/Format.h"
#include "line/file/ByteText.h"
#include "sbus/Frame.h"
#include "sbus/Scaling.h"
#include "sbus/Slots.h"

namespace tool {

namespace {

constexpr size_t ChannelBits = 11;

struct Input {
  std::vector<uint8_t> bytes;
  std::vector<std::string> problems;
};

Input parse(const std::string &text) {
  line::TextBytes bytes;
  const std::string wrong = parseHex(text, bytes);
  line::ByteText reader(text, true);
  if (!wrong.empty() && reader.hasFrames()) {  // as other people write them
    bytes.clear();
    reader.line(text, bytes);
  }
  Input input;
  for (const line::TextByte &byte : bytes) {
    input.bytes.push_back(byte.value);
    if (byte.bad) {
      input.problems.push_back(line::format("byte %zu: %02X is marked with !, a parity or framing error",
                                            input.bytes.size() - 1, static_cast<unsigned>(byte.value)));
    }
  }
  if (!wrong.empty() && !reader.hasFrames()) {
    input.problems.push_back(
        line::format("byte %zu: \"%s\" is not hexadecimal; two digits a byte are expected, such as 0F",
                     input.bytes.size(), wrong.c_str()));
  }
  return input;
}

std::string bitsOf(unsigned value, unsigned count) {
  std::string text;
  for (unsigned bit = count; bit-- > 0;) {
    text += (value >> bit & 1) != 0 ? '1' : '0';
  }
  return text;
}

// A frame, or the beginning of one, with its problems.
class Frame {
 public:
  Frame(std::vector<uint8_t> bytes, std::vector<std::string> problems)
      : _bytes(std::move(bytes)), _problems(std::move(problems)), _size(is24() ? sbus::FrameSize24 : sbus::FrameSize) {}

  void print() {
    write(
        line::format("read as a frame of %d channels, %zu bytes\n\nbyte  hex  bit 7..0  meaning\n", channels(), _size));
    for (size_t i = 0; i < _bytes.size(); i++) {
      const std::string bits = bitsOf(_bytes[i], 8);
      write(line::format("%4zu   %02X  %s  ", i, static_cast<unsigned>(_bytes[i]), bits.c_str()) + meaning(i) + '\n');
    }
    if (_bytes.size() > sbus::PayloadIndex + 1) {
      write("\nchannel  raw    us  bits, highest first\n");
      printChannels();
    }
    if (_bytes.size() < _size) {
      _problems.push_back(line::format("byte %zu is missing: a frame has %zu bytes", _bytes.size(), _size));
    }
  }

  const std::vector<std::string> &problems() const { return _problems; }

 private:
  bool isExtra() const { return _bytes[0] == sbus::ExtraHeader; }
  int channels() const { return _size == sbus::FrameSize24 ? sbus::ChannelCount24 : sbus::ProportionalCount; }
  size_t payloadEnd() const { return _size - 2; }

  // Returns true for 36 bytes, or for more than 25 if byte 24 is not an end byte.
  bool is24() const {
    return _bytes.size() == sbus::FrameSize24 ||
           (_bytes.size() > sbus::FrameSize &&
            !(sbus::isFlagsByte(_bytes[sbus::FlagsIndex]) && sbus::isEndByte(_bytes[sbus::EndIndex])));
  }

  void addProblem(size_t at, const std::string &what) { _problems.push_back(line::format("byte %zu: ", at) + what); }

  std::string meaning(size_t at) {
    return at == 0                  ? header()
           : at < payloadEnd()      ? payload(at)
           : at == payloadEnd()     ? flags(at)
           : at == payloadEnd() + 1 ? end(at)
                                    : tail(at);
  }

  std::string header() {
    if (_bytes[0] == sbus::HeaderByte) {
      return "header";
    }
    if (isExtra() && _size == sbus::FrameSize) {
      return "header of an extra frame: CH17 to CH32 of Futaba FASSTest 26";
    }
    addProblem(0, line::format("%02X is not a header; 0F%s is expected", static_cast<unsigned>(_bytes[0]),
                               _size == sbus::FrameSize ? ", or 2F of an extra frame," : ""));
    return "not a header";
  }

  std::string name(size_t channel) const { return line::format("CH%zu", channel + (isExtra() ? 17 : 1)); }

  // Returns the channel bits in the byte, highest first: "CH2 bit 4..0, CH1 bit 10..8".
  std::string payload(size_t at) const {
    const size_t first = (at - sbus::PayloadIndex) * 8;
    std::string text;
    for (size_t bit = first; bit < first + 8;) {
      const size_t channel = bit / ChannelBits;
      const size_t next = std::min(first + 8, (channel + 1) * ChannelBits);
      const size_t low = bit % ChannelBits;
      text = name(channel) + line::format(next - bit > 1 ? " bit %zu..%zu" : " bit %zu", low + (next - bit - 1), low) +
             (text.empty() ? "" : ", ") + text;
      bit = next;
    }
    return text;
  }

  std::string flags(size_t at) {
    const unsigned flags = _bytes[at];
    if (!sbus::isFlagsByte(_bytes[at])) {
      addProblem(at, line::format("%02X has unused flags set; bits 4 to 7 are 0 on every known receiver", flags));
    }
    const auto text = [flags](unsigned flag, const char *set, const char *clear) {
      return std::string((flags & flag) != 0 ? set : clear);
    };
    const bool hasSwitches = _size == sbus::FrameSize && !isExtra();
    const std::string switches = hasSwitches ? text(sbus::FlagChannel17, "CH17 on, ", "CH17 off, ") +
                                                   text(sbus::FlagChannel18, "CH18 on, ", "CH18 off, ")
                                             : "";
    return "flags: " + switches + text(sbus::FlagLostFrame, "frame lost, ", "frame not lost, ") +
           text(sbus::FlagFailsafe, "failsafe", "no failsafe") + text(sbus::FlagsUnused, ", unused bits set", "");
  }

  std::string end(size_t at) {
    constexpr const char *Texts[] = {"S.BUS", "S.BUS2", "R7003SB or FASSTest 12CH"};
    static_assert(std::size(Texts) == sbus::UnknownVariant, "a text for each row of LineVariants");
    const uint8_t variant = sbus::variantOfEnd(_bytes[at]);
    if (variant == sbus::UnknownVariant || (_size == sbus::FrameSize24 && variant >= sbus::Frame24::Variants)) {
      addProblem(at, line::format("%02X is not an end byte; 00%s is expected", static_cast<unsigned>(_bytes[at]),
                                  _size == sbus::FrameSize ? ", 04, 14, 24, 34 or 08" : ""));
      return "not an end byte";
    }
    const unsigned slot = sbus::firstSlotOf(_bytes[at]);
    const std::string slots = variant == sbus::SlotsVariant
                                  ? line::format(", telemetry slots %u to %u", slot, slot + sbus::SlotsOfGroup - 1)
                                  : std::string();
    return std::string("end byte: ") + Texts[variant] + slots;
  }

  std::string tail(size_t at) {
    const uint8_t variant =
        _size == sbus::FrameSize ? sbus::variantOfEnd(_bytes[sbus::EndIndex]) : sbus::UnknownVariant;
    if (variant < sbus::UnknownVariant && at < _size + sbus::LineVariants[variant].tailSize) {
      return "belongs to a frame with this end byte, meaning unknown";
    }
    if (at == _size || at == _size + sbus::LongestTail) {
      addProblem(at, "the frame ends before this byte; give one frame at a time");
    }
    return "not part of this frame";
  }

  void printChannels() {
    std::vector<uint8_t> whole = _bytes;
    whole.resize(sbus::FrameSize24);
    uint16_t raw[sbus::ChannelCount24];
    _size == sbus::FrameSize24 ? sbus::unpack24(whole.data(), raw)
    : isExtra()                ? sbus::unpackExtra(whole.data(), raw)
                               : sbus::unpack(whole.data(), raw);
    const size_t bits = (std::min(_bytes.size(), payloadEnd()) - sbus::PayloadIndex) * 8;
    for (size_t channel = 0; (channel + 1) * ChannelBits <= bits; channel++) {
      write(line::format("%-7s %4u %5d  ", name(channel).c_str(), static_cast<unsigned>(raw[channel]),
                         sbus::toMicroseconds(raw[channel], sbus::FrSky)) +
            sources(channel) + '\n');
    }
  }

  // Returns where the bits are: "011 of byte 2, 11100011 of byte 1".
  std::string sources(size_t channel) const {
    std::string text;
    for (size_t bit = (channel + 1) * ChannelBits; bit > channel * ChannelBits;) {
      const size_t at = (bit - 1) / 8;
      const size_t from = std::max(channel * ChannelBits, at * 8);
      const unsigned value = _bytes[sbus::PayloadIndex + at] >> (from - at * 8);
      const std::string piece = bitsOf(value, static_cast<unsigned>(bit - from));
      text += (text.empty() ? "" : ", ") + piece + line::format(" of byte %zu", at + sbus::PayloadIndex);
      bit = from;
    }
    return text;
  }

  std::vector<uint8_t> _bytes;
  std::vector<std::string> _problems;
  size_t _size;
};

void run(const std::vector<std::string> &words) {
  std::string text;
  for (const std::string &word : words) {
    text += word + ' ';
  }
  if (words.empty() || text == "- ") {
    text.assign(std::istreambuf_iterator<char>(std::cin), {});
  }
  const Input input = parse(text);
  std::vector<std::string> problems = input.problems;
  if (!input.bytes.empty()) {
    Frame frame(input.bytes, input.problems);
    frame.print();
    flush();
    problems = frame.problems();
  } else if (problems.empty()) {
    problems.push_back("no bytes; a frame in hexadecimal is expected, such as 0F E3 03 ...");
  }
  for (const std::string &problem : problems) {
    std::fprintf(stderr, "sbus explain: %s\n", problem.c_str());
  }
  if (!problems.empty()) {
    fail();
  }
}

}  // namespace

void addExplain(CLI::App &app) {
  Subcommand subcommand(app, "explain", "explains a frame byte by byte, and the bits of each channel");
  const auto words = std::make_shared<std::vector<std::string>>();
  subcommand
      .option("BYTES", *words, "a frame in hexadecimal, as words or one text; without it, or with -, standard input")
      .type("");
  subcommand.footer(
      "A frame has 25 bytes, or 36 with 24 channels. Microseconds are a FrSky's: 172, 992 and 1811 are 988, 1500 and "
      "2012.");
  subcommand.run([words] { run(*words); });
}

}  // namespace tool
