#include "line/capture/CsvReader.h"

#include <algorithm>
#include <cmath>

#include "line/capture/Parsing.h"

namespace line {

namespace {

bool isSkipped(std::string_view row) {
  return row.empty() || row.front() == ';' || row.front() == '#';
}

}  // namespace

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

// First reads all values of these rows, then looks for edges; of voltages it reads a time only at an edge.
std::string CsvReader::put(std::string_view lines) {
  for (; _lines < _layout.headLines && !lines.empty(); _lines++) {
    takeLine(lines);
  }
  _rows.clear();
  for (Signal &signal : _signals) {
    signal.values.clear();
  }
  std::string error;
  std::string_view last;
  while (!lines.empty() && error.empty()) {
    const std::string_view row = takeLine(lines);
    _lines++;
    if (isSkipped(row)) {
      continue;
    }
    error = isRepeated(row) ? "" : take(row);
    if (error.empty()) {
      last = row;
      _number++;
    }
  }
  const std::string wrong = tellLevels();
  _last = wrong.empty() && last.data() != nullptr ? std::string(last) : _last;
  return wrong.empty() ? error : wrong;
}

// Most rows of levels are equal to the previous one, and are not read any further.
bool CsvReader::isRepeated(std::string_view row) const {
  if (_layout.analogue || _number == 0) {
    return false;
  }
  return _layout.time.column != 0 ? row == _before
                                  : row.size() > _before.size() && row.substr(row.size() - _before.size()) == _before &&
                                        (isDigit(row.front()) || row.front() == '-');
}

// Appends the row and its values.
std::string CsvReader::take(std::string_view row) {
  const char *at = row.data();
  const char *const end = at + row.size();
  size_t column = 0;
  bool any = false, isCut = false;  // a row that ends before its first sample is cut, or none
  const auto skipField = [&] {
    at = std::find(at, end, _layout.separator);
    isCut = at == end;
    at += at < end;
    column++;
  };
  for (size_t i = 0; i < _signals.size(); i++) {
    while (column < _layout.signals[i].column) {
      skipField();
    }
    at = std::find_if(at, end, [](char c) { return c != ' ' && c != '"'; });
    const bool isEmpty = (at == end || *at == _layout.separator) && (any || !isCut || i + 1 < _signals.size());
    any = any || !isEmpty;
    double value = NAN;
    std::string wrong = isEmpty ? "" : takeValue(at, end, column, value);
    if (!wrong.empty()) {
      return wrong;
    }
    skipField();
    _signals[i].values.push_back(value);
  }
  _rows.push_back({row, _number, _lines});
  if (!_layout.analogue) {
    _before = _layout.time.column == 0 ? row.substr(std::min(row.size(), row.find(_layout.separator))) : row;
  }
  return {};
}

// Reads a voltage, or a level as 0 or 1. Returns what is wrong, or nothing.
std::string CsvReader::takeValue(const char *at, const char *end, size_t column, double &value) const {
  const bool isLevel = end - at > 1 && at[1] == _layout.separator && (*at == '0' || *at == '1');  // most are
  value = isLevel ? *at - '0' : NAN;
  if (isLevel || (_layout.analogue && takeNumber(at, end, value, _layout.time.decimalMark))) {
    return {};
  }
  const std::string_view field = trimmed({at, static_cast<size_t>(std::find(at, end, _layout.separator) - at)});
  const char level = field.size() == 1 ? field.front() : field.empty() ? 'x' : '?';
  value = level == '0' ? 0 : level == '1' ? 1 : NAN;
  if (!_layout.analogue && at != end && std::string_view("01xXzZ").find(level) != std::string_view::npos) {
    return {};
  }
  const std::string there = "column " + std::to_string(column + 1);
  return _layout.analogue ? quoted(field) + " is not a voltage: a number is expected in " + there
         : at == end      ? "the row ends after column " + std::to_string(column) + ": " + there + " is expected"
                          : quoted(field) + " is not a level: 0 or 1 is expected in " + there;
}

std::string CsvReader::tellLevels() {
  for (Signal &signal : _signals) {
    signal.level.learn(signal.values);
  }
  for (size_t i = 0; i < _rows.size(); i++) {
    int64_t ns = 0;
    bool hasTime = false;
    for (size_t s = 0; s < _signals.size(); s++) {
      Signal &signal = _signals[s];
      const bool isEdge = signal.level.changes(signal.values[i]);
      if (!hasTime && (isEdge || !_layout.analogue)) {
        const std::string wrong = timeOf(_rows[i].text, _rows[i].number, ns);
        if (!wrong.empty()) {
          _lines = _rows[i].line;
          return wrong;
        }
        hasTime = true;
      }
      if (isEdge) {
        _sink.level(s, ns, signal.level.isHigh());
      }
    }
  }
  return {};
}

std::string CsvReader::timeOf(std::string_view row, uint64_t number, int64_t &ns) {
  double value = _layout.startNs + static_cast<double>(number) * _layout.periodNs;
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
  return !_last.empty() && timeOf(_last, _number, ns).empty() ? ns : _endNs;
}

}  // namespace line
