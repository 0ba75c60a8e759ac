#include "cli/SentFrames.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "cli/Pipe.h"
#include "line/capture/Text.h"
#include "line/capture/TextFile.h"
#include "line/recording/CsvRows.h"
#include "line/recording/Recording.h"
#include "line/recording/Words.h"
#include "sbus/Scaling.h"

namespace tool {

namespace {

constexpr uint64_t RowUs = 200000;  // as `sbus csv` prints them

enum class Column { Time, Channel, Failsafe, LostFrame, None };

struct Name {
  Column column = Column::None;
  size_t channel = 0;  // counted from 0
};

// Returns false if the text names no column of `sbus csv`.
bool parseName(const std::string &text, Name &name) {
  const std::string word = line::lower(text);
  double channel = 0;
  if (word.rfind("ch", 0) == 0 && line::parseNumber(word.substr(2), channel) && channel >= 1 &&
      channel <= sbus::ChannelCount && channel == std::floor(channel)) {
    name = {Column::Channel, static_cast<size_t>(channel) - 1};
    return true;
  }
  name.column = word == "failsafe"    ? Column::Failsafe
                : word == "lostframe" ? Column::LostFrame
                : word == "time"      ? Column::Time
                                      : Column::None;
  return name.column != Column::None || word == "state" || word == "age";
}

bool isSwitch(const Name &name) {
  return name.column != Column::Channel || name.channel >= sbus::ProportionalCount;
}

// Returns true for 0 and 1 of a switch or flag, and for 0 to 2047 of a channel.
bool isValue(const Name &name, double value) {
  return value >= 0 && value <= (isSwitch(name) ? 1 : sbus::ChannelMax) && value == std::floor(value);
}

void set(const Name &name, unsigned value, FrameValues &values) {
  if (name.column == Column::Channel) {
    values.channels[name.channel] = static_cast<uint16_t>(value);
  } else {
    (name.column == Column::Failsafe ? values.failsafe : values.lostFrame) = value != 0;
  }
}

std::string nameOf(line::CsvKind kind, size_t column) {
  switch (kind) {
    case line::CsvKind::Failsafe:
      return "failsafe";
    case line::CsvKind::LostFrame:
      return "lostFrame";
    case line::CsvKind::Switch17:
      return "CH17";
    case line::CsvKind::Switch18:
      return "CH18";
    case line::CsvKind::Channel:
      break;
  }
  return "CH" + std::to_string(column + 1);
}

// Returns the names of the columns of the newest row.
std::vector<std::string> namesOf(const line::CsvRows &rows, bool isHeader) {
  std::vector<std::string> names;
  for (size_t i = 0; i < rows.row().size(); i++) {
    names.push_back(isHeader ? rows.row()[i].text : nameOf(rows.kind(i), i));
  }
  return names;
}

class RowReader {
 public:
  explicit RowReader(const std::string &file) : _file(file) {}

  void put(const std::string &text) {
    _number++;
    if (text.find_first_not_of(" \t\r") == std::string::npos || text.front() == '#') {
      return;
    }
    for (const char letter : text + '\n') {
      _parser.put(static_cast<uint8_t>(letter));
    }
    const line::CsvRow &row = _parser.row();
    if (_columns.empty()) {
      const bool isHeader = !row.front().isNumber;
      takeNames(namesOf(_parser, isHeader));
      if (isHeader) {
        return;
      }
    }
    takeRow(row);
  }

  TimedRows finish() {
    if (_rows.rows.empty()) {
      throw std::runtime_error(_file + ": has no rows; rows as sbus csv writes them are expected");
    }
    const size_t count = _rows.rows.size();
    const uint64_t lastUs = _rows.rows.back().us;
    _rows.endUs = lastUs + (count > 1 ? lastUs - _rows.rows[count - 2].us : RowUs);
    return std::move(_rows);
  }

 private:
  [[noreturn]] void fail(const std::string &what) const {
    throw std::runtime_error(_file + ":" + std::to_string(_number) + ": " + what);
  }

  void takeNames(const std::vector<std::string> &names) {
    for (const std::string &each : names) {
      Name name;
      if (!parseName(each, name)) {
        fail(line::quoted(each) +
             " is no column of sbus csv; there are CH1 to CH18, failsafe, lostframe, time, state and age");
      }
      _columns.push_back(name);
    }
  }

  void takeRow(const line::CsvRow &row) {
    if (row.size() != _columns.size()) {
      fail("has " + std::to_string(row.size()) + " fields; " + std::to_string(_columns.size()) + " are expected");
    }
    TimedValues timed{_rows.rows.size() * RowUs, FrameValues()};
    for (size_t i = 0; i < row.size(); i++) {
      const Name &name = _columns[i];
      if (name.column == Column::Time) {
        timed.us = timeOf(row[i]);
      } else if (name.column != Column::None && (!row[i].isNumber || !isValue(name, row[i].value))) {
        fail(line::quoted(row[i].text) + " is no value of column " + std::to_string(i + 1) + "; " +
             (isSwitch(name) ? "0 or 1 is expected" : "0 to 2047 is expected"));
      } else if (name.column != Column::None) {
        set(name, static_cast<unsigned>(row[i].value), timed.values);
      }
    }
    _rows.rows.push_back(timed);
  }

  uint64_t timeOf(const line::CsvField &field) {
    const bool isFirst = _rows.rows.empty();
    if (!field.isNumber || field.value < 0 || field.value * 1e6 > static_cast<double>(line::RecordingTimeMaxUs)) {
      fail(line::quoted(field.text) + " is no time; seconds are expected");
    }
    const auto us = static_cast<uint64_t>(std::llround(field.value * 1e6));
    _zeroUs = isFirst ? us : _zeroUs;
    if (!isFirst && us < _zeroUs + _rows.rows.back().us + 1) {
      fail("time " + field.text + " does not come after that of the row before");
    }
    return us - _zeroUs;
  }

  const std::string _file;
  size_t _number = 0;  // of the newest line
  line::CsvRows _parser;
  std::vector<Name> _columns;
  uint64_t _zeroUs = 0;  // of the first row
  TimedRows _rows;
};

}  // namespace

void assign(const std::string &word, FrameValues &values) {
  const size_t equals = word.find('=');
  Name name;
  if (equals == std::string::npos || !parseName(word.substr(0, equals), name) || name.column == Column::None ||
      name.column == Column::Time) {
    throw std::runtime_error(line::quoted(word) +
                             " sets nothing; ch1=VALUE to ch18=VALUE, failsafe=on and lostframe=on do");
  }
  std::string text = line::lower(word.substr(equals + 1));
  const bool isOn = text == "on";
  double value = 0;
  if (isOn || text == "off") {
    value = isSwitch(name) ? isOn : isOn ? sbus::FrSky.high : sbus::FrSky.low;
  } else if (text.find_first_not_of("0123456789") != std::string::npos || !line::parseNumber(text, value) ||
             !isValue(name, value)) {
    throw std::runtime_error(
        line::quoted(word) + " is out of range; " +
        (isSwitch(name) ? "on or off is expected" : "0 to 2047, on (1811) or off (172) is expected"));
  }
  set(name, static_cast<unsigned>(value), values);
}

TimedRows readTimedRows(const std::string &name) {
  Pipe pipe(name);
  line::PackedFile file(pipe.wholeFile().path, name);
  file.findOnly();
  RowReader reader(name);
  line::forEachLine(file, [&reader](std::string_view line) { reader.put(std::string(line)); });
  return reader.finish();
}

bool FrameLine::next(uint64_t nowUs, line::Character &character) {
  const uint64_t endUs = _frameUs + (_index + 1) * _characterUs;
  if (endUs > nowUs || ended()) {
    return false;
  }
  if (_index == 0) {
    beginFrame();
  }
  character = {endUs, _frame[_index], false};
  if (++_index == sbus::FrameSize) {
    _index = 0;
    _frameUs += _periodUs;
  }
  return true;
}

void FrameLine::beginFrame() {
  while (_row + 1 < _rows.rows.size() && _rows.rows[_row + 1].us <= _frameUs) {
    _row++;
  }
  const FrameValues &values = _rows.rows[_row].values;
  sbus::pack(_frame, values.channels.data(), values.failsafe, values.lostFrame);
}

}  // namespace tool
