#include "line/capture/CsvReader.h"

#include <algorithm>
#include <cmath>

#include "line/capture/Parsing.h"

namespace line {

CsvReader::CsvReader(CsvLayout layout, LevelSink &sink, std::optional<double> threshold)
    : CaptureReader(sink), _layout(std::move(layout)), _isGiven(threshold.has_value()) {
  _periodNs = _layout.periodNs;
  std::vector<std::string> names;
  for (const CsvSignal &signal : _layout.signals) {
    _signals.push_back({AnalogueLevel(_layout.analogue ? threshold : 0.5), {}});
    names.push_back(signal.name);
  }
  _sink.signals(names);
}

// First reads all values of these rows, then looks for edges: only now is a threshold known.
std::string CsvReader::put(std::string_view lines) {
  for (; _lines < _layout.headLines && !lines.empty(); _lines++) {
    takeLine(lines);
  }
  _times.clear();
  for (Signal &signal : _signals) {
    signal.values.clear();
  }
  std::string error;
  while (!lines.empty() && error.empty()) {
    const std::string_view row = takeLine(lines);
    _lines++;
    if (!row.empty() && row.front() != ';' && row.front() != '#') {
      error = take(row);
    }
  }
  for (Signal &signal : _signals) {
    signal.level.learn(signal.values);
  }
  for (size_t i = 0; i < _times.size(); i++) {
    for (size_t s = 0; s < _signals.size(); s++) {
      if (_signals[s].level.changes(_signals[s].values[i])) {
        _sink.level(s, _times[i], _signals[s].level.isHigh());
      }
    }
  }
  return error;
}

// Appends the row's time and values. An empty field is no sample; a row that ends before its first sample is cut.
std::string CsvReader::take(std::string_view row) {
  splitRow(row, _layout.separator, _fields);
  _row.assign(_signals.size(), NAN);
  const size_t first = _layout.signals.front().column;
  if (_fields.size() <= first && row.back() != _layout.separator) {
    return "the row ends after column " + std::to_string(first) + ": column " + std::to_string(first + 1) +
           " is expected";
  }
  for (size_t i = 0; i < _signals.size(); i++) {
    const size_t column = _layout.signals[i].column;
    const std::string_view field = column < _fields.size() ? _fields[column] : "";
    const bool isLevel =
        field == "0" || field == "1" || (field.size() == 1 && std::string_view("xXzZ").find(field[0]) != field.npos);
    if (!field.empty() && !(_layout.analogue ? parseNumber(field, _row[i], _layout.time.decimalMark) : isLevel)) {
      return quoted(field) + (_layout.analogue ? " is not a voltage: a number" : " is not a level: 0 or 1") +
             " is expected in column " + std::to_string(column + 1);
    }
    if (!_layout.analogue && (field == "0" || field == "1")) {
      _row[i] = field[0] - '0';
    }
  }
  const std::string wrong = takeTime();
  for (size_t i = 0; i < _signals.size() && wrong.empty(); i++) {
    _signals[i].values.push_back(_row[i]);
  }
  return wrong;
}

std::string CsvReader::takeTime() {
  double ns = _layout.startNs + static_cast<double>(_number++) * _layout.periodNs;
  if (_layout.time.column != TimeColumn::None) {
    const std::string wrong = _layout.time.read(_fields, ns);
    if (!wrong.empty()) {
      return wrong;
    }
  } else if (!(std::abs(ns) <= static_cast<double>(CaptureTimeMaxNs))) {
    return "a time is beyond a year: is its unit right?";
  }
  if (_number > 1 && std::llround(ns) < _endNs) {
    return "a time is before that of a row above: times in order are expected";
  }
  _endNs = std::llround(ns);
  _times.push_back(_endNs);
  return {};
}

}  // namespace line
