#include "line/file/DecodedReader.h"

#include <cmath>

#include "line/FrameBytes.h"
#include "line/capture/Parsing.h"
#include "line/file/ByteText.h"
#include "line/recording/Recording.h"
#include "line/recording/Words.h"

namespace line {

namespace {

// Takes the time off a row of sbus hex, "    0.008000  0F E0 ... 00  frame end 00", and leaves its bytes.
bool takeHexRow(std::string_view &row, double &ms) {
  constexpr size_t TimeSize = 12, Decimals = 7;
  if (row.size() < TimeSize + 2 || row.substr(TimeSize, 2) != "  ") {
    return false;
  }
  const size_t bad = row.find("! ", TimeSize),
               end = std::min(row.find("  ", TimeSize + 2), bad == row.npos ? bad : bad + 1);
  const std::string_view time = withoutBlanks(row.substr(0, TimeSize)), why = row.substr(std::min(end, row.size()));
  const bool is = time.size() > Decimals && time[time.size() - Decimals] == '.' && parseNumber(time, ms) &&
                  withoutBlanks(why).find(' ') != why.npos;
  if (is) {
    ms *= 1000;
    row = row.substr(TimeSize, end - TimeSize);
  }
  return is;
}

}  // namespace

// What a terminal shows before it is left out.
bool DecodedReader::reads(std::string_view text) {
  bool reads = false;
  for (int lines = 0; lines < 5 && !text.empty() && !reads; lines++) {
    std::string_view line = takeLine(text);
    const bool isFound = line.find(" carries S.Bus") != line.npos || line.find(" but no frame of S.Bus") != line.npos;
    std::string_view row = line;
    double ms = 0;
    reads = takeHexRow(row, ms);
    const std::string_view first = takeWord(line), second = takeWord(line), third = takeWord(line);
    reads = reads || (first == "signal" && isFound) ||
            (first == "time" && second == "ms" && (third == "CH1" || third == "byte"));
  }
  return reads;
}

LineSettings DecodedReader::settings(std::string_view text) {
  const size_t begin = text.find(" carries S.Bus");
  if (begin == text.npos) {
    return {};
  }
  const std::string_view line = text.substr(0, text.find('\n', begin));
  return settingsIn("# " + std::string(line.substr(line.rfind(": ") + 2)));
}

// A row of sbus hex has its own time. A blank line ends a table: a heading comes next, or what the whole capture has.
std::string DecodedReader::line(std::string_view text, std::deque<Character> &characters) {
  std::string_view rest = text;
  double ms = 0;
  if (takeHexRow(rest, ms)) {
    std::vector<Character> came;
    return parseHex(rest, came) ? put(std::llround(ms * 1000), 0, came, characters)
                                : quoted(withoutBlanks(rest)) + " are no bytes";
  }
  const std::string_view first = takeWord(rest), values = rest, second = takeWord(rest);
  if (first == "time" && second != "ms") {
    return "times in ms are expected, as sbus decode prints them";
  }
  if (first.empty() || first == "time") {
    _columns.clear();
    for (std::string_view word = takeWord(rest); !word.empty(); word = takeWord(rest)) {
      _columns.emplace_back(word);
    }
    return {};
  }
  const bool areOthers = second == "no", areCharacters = !_columns.empty() && _columns.front() == "byte";
  if (second == "byte" || (_columns.empty() && !areOthers)) {
    const bool isCut = _any && second != "byte" && text.substr(0, 1) == " " && parseNumber(first, ms);
    return isCut ? "the row is cut: bytes and what they are, as sbus hex prints them, are expected" : "";
  }
  if (!parseNumber(first, ms) || std::abs(ms) * 1000 > static_cast<double>(RecordingTimeMaxUs)) {
    return quoted(first) + " is not a time in milliseconds";
  }
  std::vector<Character> came;
  if (!areOthers && !areCharacters) {
    const std::string wrong = frame(values, came);
    if (!wrong.empty()) {
      return wrong;
    }
  } else if (!parseHex(areOthers ? rest.substr(rest.rfind(':') + 1) : second, came)) {
    return quoted(withoutBlanks(values)) + " has no bytes";
  }
  came.back().bad = came.back().bad || (areCharacters && !rest.empty());
  return put(std::llround(ms * 1000) + (areCharacters ? _characterUs : 0), 0, came, characters);
}

// Reads 16 channels and two switches, or 24 channels; then the end byte and the flags.
std::string DecodedReader::frame(std::string_view row, std::vector<Character> &came) const {
  const size_t channels = _columns.size() - 1;
  const bool isExtra = _columns.front() == "CH17", is24 = channels == sbus::ChannelCount24;
  bool good = channels == (is24 ? channels : sbus::ChannelCount);
  Values values;
  for (size_t i = 0; i < channels && good; i++) {
    const bool isSwitch = !is24 && i >= sbus::ProportionalCount;
    uint16_t value = 0;
    good = parseWhole(takeWord(row), value) && value <= (isSwitch ? 1 : sbus::ChannelMax);
    if (isSwitch) {
      values.switches[i - sbus::ProportionalCount] = value != 0;
    } else {
      values.raw[i + (isExtra ? sbus::ProportionalCount : 0)] = value;
    }
  }
  uint8_t end = 0;
  if (!good || !parseWhole(takeWord(row), end, 16)) {
    return "a row as sbus decode prints it is expected: channels from 0 to 2047, and an end byte";
  }
  values.lostFrame = row.find("lost frame") != row.npos;
  values.failsafe = row.find("failsafe") != row.npos;
  using Kind = Stretch::Kind;
  came = charactersOf(frameBytes(is24 ? Kind::Frame24 : isExtra ? Kind::Extra : Kind::Frame, values, end));
  return {};
}

std::string DecodedReader::finish(std::deque<Character> & /*characters*/) {
  return _any ? "" : "has no characters; a table as sbus decode or hex prints it is expected";
}

}  // namespace line
