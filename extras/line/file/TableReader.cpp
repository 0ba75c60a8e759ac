#include "line/file/TableReader.h"

#include <cmath>
#include <stdexcept>

#include "line/FrameBytes.h"
#include "line/capture/Parsing.h"
#include "line/recording/Recording.h"
#include "line/recording/Words.h"

namespace line {

namespace {

constexpr uint64_t FrameUsMost = 50000;
constexpr size_t SwitchesAt = sbus::ProportionalCount;  // CH17 and CH18, in a table that ends there

// Returns true for an empty line or a comment.
bool isNothing(std::string_view text) { return withoutBlanks(text).empty() || text.front() == '#'; }

bool isFlag(double value) { return value == 0 || value == 1; }

}  // namespace

bool TableRows::parseName(const std::string &text, Column &column) {
  const std::string word = lower(text);
  double channel = 0;
  const bool isChannel = word.rfind("ch", 0) == 0 && parseNumber(word.substr(2), channel) && channel >= 1 &&
                         channel <= TableChannelMax && channel == std::floor(channel);
  if (isChannel) {
    column = {Kind::Channel, static_cast<size_t>(channel) - 1};
    return true;
  }
  column.kind = word == "time" || word == "seconds" ? Kind::Time
                : word == "failsafe"                ? Kind::Failsafe
                : word == "lostframe"               ? Kind::LostFrame
                : word == "dg1" || word == "dg2"    ? Kind::Switch
                                                    : Kind::Ignored;
  column.index = word == "dg2" ? 1 : 0;
  return column.kind != Kind::Ignored || word == "state" || word == "age" || word == "quality";
}

std::string TableRows::line(std::string_view text) {
  _isRow = false;
  if (isNothing(text)) {
    return {};
  }
  for (const char letter : text) {
    _parser.put(static_cast<uint8_t>(letter));
  }
  _parser.put(uint8_t{'\n'});
  if (!_columns.empty()) {
    return takeRow(_parser.row());
  }
  return takeNames() ? "" : "a line of names as sbus csv prints it is expected";
}

std::string TableRows::cutLine(std::string_view text) {
  _isRow = false;
  return isNothing(text) ? "" : "the file may be cut within this row: a line end is expected after it";
}

bool TableRows::takeNames() {
  for (const CsvField &field : _parser.row()) {
    Column column;
    const bool isKnown = parseName(field.text, column);
    const bool isAgain =
        column.kind != Kind::Ignored && std::any_of(_columns.begin(), _columns.end(), [&column](const Column &other) {
          return other.kind == column.kind && other.index == column.index;
        });
    if (!isKnown || isAgain) {
      return false;
    }
    _channels = column.kind == Kind::Channel ? std::max(_channels, column.index + 1) : _channels;
    _columns.push_back(column);
  }
  if (_channels > sbus::ChannelCount && _channels != sbus::ChannelCount24 && _channels != TableChannelMax) {
    return false;
  }
  if (_channels <= sbus::ChannelCount) {
    for (Column &column : _columns) {
      if (column.kind == Kind::Channel && column.index >= SwitchesAt) {
        column.kind = Kind::Switch;
        column.index -= SwitchesAt;
      }
    }
  }
  return true;
}

bool TableRows::isWhole() const {
  bool has[TableChannelMax] = {};
  bool hasTime = false;
  for (const Column &column : _columns) {
    hasTime = hasTime || column.kind == Kind::Time;
    if (column.kind == Kind::Channel) {
      has[column.index] = true;
    }
  }
  const size_t most = std::max<size_t>(sbus::ProportionalCount, _channels <= sbus::ChannelCount ? 0 : _channels);
  return hasTime && (most == sbus::ProportionalCount || most == sbus::ChannelCount24 || most == TableChannelMax) &&
         std::all_of(has, has + most, [](bool each) { return each; });
}

std::string TableRows::takeRow(const CsvRow &fields) {
  if (fields.size() != _columns.size()) {
    return "has " + std::to_string(fields.size()) + " fields; " + std::to_string(_columns.size()) + " are expected";
  }
  _row = {};
  for (size_t i = 0; i < fields.size(); i++) {
    const std::string wrong = takeField(_columns[i], fields[i]);
    if (!wrong.empty()) {
      return quoted(fields[i].text) + " is not a value for column " + std::to_string(i + 1) + "; " + wrong;
    }
  }
  if (_row.us && _lastUs && *_row.us < *_lastUs) {
    return "its time is before that of the previous row";
  }
  _lastUs = _row.us;
  _isRow = true;
  return {};
}

// Returns what is expected instead of a wrong field; nothing for a valid one.
std::string TableRows::takeField(const Column &column, const CsvField &field) {
  const bool isEmpty = field.text.empty();
  switch (column.kind) {
    case Kind::Time:
      return takeTime(field);
    case Kind::Channel:
      if (isEmpty && _channels == TableChannelMax) {
        return {};  // each frame has half of 32 channels
      }
      if (!field.isNumber || field.value < 0 || field.value > sbus::ChannelMax ||
          field.value != std::floor(field.value)) {
        return "0 to 2047 is expected";
      }
      _row.values.raw[column.index] = static_cast<uint16_t>(field.value);
      (column.index < sbus::ProportionalCount ? _row.hasFirst : _row.hasRest) = true;
      return {};
    case Kind::Ignored:
      return {};
    case Kind::Switch:
    case Kind::Failsafe:
    case Kind::LostFrame:
      break;
  }
  if (isEmpty && _channels == TableChannelMax) {
    return {};
  }
  bool &flag = column.kind == Kind::Switch     ? _row.values.switches[column.index]
               : column.kind == Kind::Failsafe ? _row.values.failsafe
                                               : _row.values.lostFrame;
  flag = field.value != 0;
  return field.isNumber && isFlag(field.value) ? "" : "0 or 1 is expected";
}

std::string TableRows::takeTime(const CsvField &field) {
  if (field.text == "-") {
    return {};
  }
  const double us = field.value * 1e6;
  if (!field.isNumber || std::abs(us) > static_cast<double>(RecordingTimeMaxUs)) {
    return "a time in seconds is expected";
  }
  _row.us = std::llround(us);
  return {};
}

uint64_t appendFrames(const TableRow &row, size_t channels, uint64_t endUs, uint64_t lastUs, uint32_t characterUs,
                      std::deque<Character> &characters) {
  using Kind = Stretch::Kind;
  const auto append = [&](Kind kind, uint64_t us) {
    const std::vector<uint8_t> bytes = frameBytes(kind, row.values);
    lastUs = appendBackToBack(charactersOf(bytes), us, lastUs, characterUs, characters);
  };
  if (channels == sbus::ChannelCount24) {
    append(Kind::Frame24, endUs);
    return lastUs;
  }
  const bool isPair = channels == TableChannelMax;
  const uint64_t firstUs = sbus::FrameSize * uint64_t{characterUs} + 1000;  // a frame and a gap after it
  if (isPair && row.hasRest) {
    append(Kind::Extra, endUs - (row.hasFirst ? std::min(endUs, firstUs) : 0));
  }
  if (!isPair || row.hasFirst) {
    append(Kind::Frame, endUs);
  }
  return lastUs;
}

std::string TableReader::line(std::string_view text, std::deque<Character> &characters) {
  const std::string wrong = _rows.line(text);
  if (!wrong.empty() || !_rows.isRow()) {
    return wrong;
  }
  const uint64_t endUs = endOf(_rows.row().us, 2 * sbus::FrameSize24 * _characterUs);  // a row may be two frames
  placed(endUs, appendFrames(_rows.row(), _rows.channels(), endUs, _lastUs, _characterUs, characters));
  return {};
}

FrameTable frameTable(std::string_view head) {
  TableRows rows;
  std::optional<int64_t> lastUs;
  int count = 0;
  while (head.find('\n') != std::string_view::npos) {
    if (!rows.line(takeLine(head)).empty()) {
      return FrameTable::No;
    }
    if (!rows.isRow()) {
      continue;
    }
    if (!rows.isWhole() ||
        (count > 0 && lastUs && rows.row().us && *rows.row().us > *lastUs + static_cast<int64_t>(FrameUsMost))) {
      return FrameTable::No;
    }
    lastUs = rows.row().us;
    if (++count == 2) {
      return FrameTable::Yes;
    }
  }
  return rows.isWhole() ? FrameTable::Maybe : FrameTable::No;
}

std::string assign(const std::string &word, const sbus::Range &range, FrameValues &values) {
  const size_t equals = word.find('=');
  const std::string name = lower(word.substr(0, equals));
  const std::string text = equals == std::string::npos ? "" : lower(word.substr(equals + 1));
  const size_t number = channelOf(name);
  const bool isChannel = number >= 1 && number <= sbus::ChannelCount;
  const size_t channel = isChannel ? number - 1 : 0;
  const bool isSwitch = !isChannel || channel >= SwitchesAt;
  if (equals == std::string::npos || (!isChannel && name != "failsafe" && name != "lostframe")) {
    return quoted(word) + " sets nothing; ch1=VALUE to ch18=VALUE, failsafe=on and lostframe=on do";
  }
  if (isSwitch) {
    if (text != "on" && text != "off" && text != "0" && text != "1") {
      return quoted(word) + " is out of range; on or off is expected";
    }
    bool &flag = isChannel            ? values.switches[channel - SwitchesAt]
                 : name == "failsafe" ? values.failsafe
                                      : values.lostFrame;
    flag = text == "on" || text == "1";
    return {};
  }
  const std::optional<uint16_t> raw = text == "on" ? range.high : text == "off" ? range.low : parseValue(text, range);
  if (!raw) {
    return quoted(word) + " is out of range; 0 to 2047, a pulse such as 1500us, a part such as -50%, on (" +
           std::to_string(range.high) + ") or off (" + std::to_string(range.low) + ") is expected";
  }
  values.raw[channel] = *raw;
  return {};
}

}  // namespace line
