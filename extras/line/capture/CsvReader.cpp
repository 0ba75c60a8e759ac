#include "line/capture/CsvReader.h"

#include <algorithm>
#include <cmath>

#include "line/capture/Parsing.h"

namespace line {

namespace {

// Returns the level of a probe, 0 or 1; NaN if the number does not hold eight.
double bitOf(double probes, int bit) {
  const bool isWord = probes >= 0 && probes <= UINT8_MAX;
  return isWord ? static_cast<double>(static_cast<unsigned>(probes) >> bit & 1) : NAN;
}

bool isSkipped(std::string_view row) {
  return row.empty() || row.front() == ';' || row.front() == '#';
}

}  // namespace

CsvReader::CsvReader(CsvLayout layout, LevelSink &sink) : CaptureReader(sink), _layout(std::move(layout)) {
  _periodNs = _layout.periodNs;
  std::vector<std::string> names;
  for (const CsvSignal &signal : _layout.signals) {
    names.push_back(signal.name);
  }
  _sink.signals(names);
}

std::string CsvReader::put(std::string_view lines) {
  while (_lines < _layout.headLines && !lines.empty()) {
    takeLine(lines);
    _lines++;
  }
  return rows(lines);
}

std::string CsvReader::rowTime(std::string_view row, int64_t &ns) {
  double value = _layout.startNs + static_cast<double>(_row) * _layout.periodNs;
  if (_layout.time.column != TimeColumn::None) {
    splitRow(row, _layout.separator, _fields);
    const std::string wrong = _layout.time.read(_fields, value);
    if (!wrong.empty()) {
      return wrong;
    }
  } else if (!(std::abs(value) <= static_cast<double>(CaptureTimeMaxNs))) {
    return "a time is beyond a year: is its unit right?";
  }
  ns = std::llround(value);
  if (_hasTime && ns < _endNs) {
    return "a time is before that of a row above: times in order are expected";
  }
  _endNs = ns;
  _hasTime = true;
  return {};
}

// Most rows' times are never read; the last row's is needed.
int64_t CsvReader::endNs() {
  int64_t ns;
  return !_last.empty() && rowTime(_last, ns).empty() ? ns : _endNs;
}

// Most rows are equal to the previous one, and are not read any further.
std::string DigitalReader::rows(std::string_view text) {
  const bool timed = _layout.time.column == 0;
  std::string_view last = _last;
  std::string error;
  while (!text.empty()) {
    const std::string_view row = takeLine(text);
    _lines++;
    if (isSkipped(row)) {
      continue;
    }
    const bool same = timed ? row.size() > _values.size() && row.substr(row.size() - _values.size()) == _values &&
                                  (isDigit(row.front()) || row.front() == '-')
                            : row == _values;
    if (!same || _row == 0) {
      error = changed(row);
      if (!error.empty()) {
        break;
      }
      _values = timed ? row.substr(std::min(row.size(), row.find(_layout.separator))) : row;
    }
    last = row;
    _row++;
  }
  _last = std::string(last);
  return error;
}

std::string DigitalReader::changed(std::string_view row) {
  int64_t ns;
  std::string error = rowTime(row, ns);
  if (!error.empty()) {
    return error;
  }
  splitRow(row, _layout.separator, _fields);
  for (size_t i = 0; i < _layout.signals.size(); i++) {
    const size_t column = _layout.signals[i].column;
    if (column >= _fields.size()) {
      return "the row ends after column " + std::to_string(_fields.size()) + ": column " + std::to_string(column + 1) +
             " is expected";
    }
    const std::string_view field = _fields[column];
    const char level = field.size() == 1 ? field.front() : field.empty() ? 'x' : '?';
    if (level == '0' || level == '1') {
      tell(i, level == '1');
    } else if (std::string_view("xXzZ").find(level) == std::string_view::npos) {
      return quoted(field) + " is not a level: 0 or 1 is expected in column " + std::to_string(column + 1);
    }
  }
  return {};
}

AnalogueReader::AnalogueReader(CsvLayout layout, LevelSink &sink, std::optional<double> threshold)
    : CsvReader(std::move(layout), sink),
      _isGiven(threshold.has_value()) {
  for (const CsvSignal &signal : _layout.signals) {
    _signals.push_back({AnalogueLevel(signal.bit < 0 ? threshold : 0.5), {}});
  }
}

// First reads all voltages of these rows, then looks for edges; it reads a time only at an edge.
std::string AnalogueReader::rows(std::string_view text) {
  _rows.clear();
  for (Signal &signal : _signals) {
    signal.volts.clear();
  }
  std::string error;
  while (!text.empty() && error.empty()) {
    const std::string_view row = takeLine(text);
    _lines++;
    error = isSkipped(row) ? "" : takeVolts(row);
  }
  for (Signal &signal : _signals) {
    signal.level.learn(signal.volts);
  }
  for (size_t i = 0; i < _rows.size(); i++, _row++) {
    for (size_t s = 0; s < _signals.size(); s++) {
      Signal &signal = _signals[s];
      if (!signal.level.changes(signal.volts[i])) {
        continue;
      }
      int64_t ns;
      std::string wrong = rowTime(_rows[i], ns);
      if (!wrong.empty()) {
        _lines -= _rows.size() - 1 - i;
        return wrong;
      }
      _sink.level(s, ns, signal.level.isHigh());
    }
  }
  if (!_rows.empty()) {
    _last = _rows.back();
  }
  return error;
}

std::string AnalogueReader::takeVolts(std::string_view row) {
  const char *at = row.data();
  const char *end = at + row.size();
  size_t column = 0;
  bool any = false, isCut = false;  // a row that ends before its first sample is cut, or none
  const auto skipField = [&] {
    at = std::find(at, end, _layout.separator);
    isCut = at == end;
    at += at < end;
  };
  double volts = NAN;
  for (size_t i = 0; i < _signals.size(); i++) {
    const CsvSignal &signal = _layout.signals[i];
    if (signal.bit > 0) {  // the column is read
      _signals[i].volts.push_back(bitOf(volts, signal.bit));
      continue;
    }
    for (; column < signal.column; column++) {
      skipField();
    }
    while (at < end && *at == ' ') {
      at++;
    }
    volts = NAN;
    const bool isEmpty = (at == end || *at == _layout.separator) && (any || !isCut || i + 1 < _signals.size());
    any = any || !isEmpty;
    if (!isEmpty && !takeVoltage(at, end, volts, _layout.time.decimalMark)) {
      const std::string_view word(at, static_cast<size_t>(std::find(at, end, _layout.separator) - at));
      return quoted(word) + " is not a voltage: a number is expected in column " + std::to_string(column + 1);
    }
    _signals[i].volts.push_back(signal.bit < 0 ? volts : bitOf(volts, signal.bit));
    skipField();
    column++;
  }
  _rows.push_back(row);
  return {};
}

}  // namespace line
