#include "line/capture/AsyncReader.h"

#include <algorithm>
#include <cmath>

#include "line/capture/Parsing.h"
#include "line/uart/Levels.h"

namespace line {

namespace {

constexpr const char *OneAnalyser = "Async Serial";  // Logic 1 gives no name

// Takes "0x0F", "0b00001111" or, by default in this base, "15". Returns false for anything else: Logic can also export
// bytes as characters, which are ambiguous.
bool parseByte(std::string_view word, int base, unsigned &value) {
  const int marked = word.substr(0, 2) == "0x" ? 16 : word.substr(0, 2) == "0b" ? 2 : 0;
  word.remove_prefix(marked == 0 ? 0 : 2);
  return parseWhole(word, value, marked == 0 ? base : marked) && value <= UINT8_MAX;
}

}  // namespace

AsyncReader::Columns AsyncReader::columnsOf(std::string_view title) {
  std::vector<std::string_view> fields;
  splitRow(title, ',', fields);
  Columns columns;
  columns.count = fields.size();
  const struct {
    std::string_view name;
    size_t &column;
  } rows[] = {{"name", columns.name},
              {"type", columns.type},
              {"start_time", columns.time.column},
              {"data", columns.value},
              {"value", columns.value},
              {"error", columns.error},
              {"parity error", columns.parity},
              {"framing error", columns.framing}};
  for (size_t i = 0; i < fields.size(); i++) {
    for (const auto &row : rows) {
      if (lower(fields[i]) == row.name) {
        row.column = i;
      }
    }
    if (lower(fields[i]).rfind("time", 0) == 0) {
      columns.time.column = i;
      columns.time.unitNs = unitOf(fields[i]);
    }
    // DSView: "Id,Time[ns],0:UART: RX/TX"
    if (columns.value == None && hasWord(fields[i], {"uart"})) {
      columns.value = i;
      columns.isDsView = true;
    }
  }
  return columns;
}

bool AsyncReader::isHead(std::string_view head) {
  const Columns columns = columnsOf(takeLine(head));
  const bool isLogic1 = columns.parity != None && columns.framing != None;
  const bool isLogic2 = columns.name != None && columns.type != None;
  return columns.time.column != None && columns.value != None && (isLogic1 || isLogic2 || columns.isDsView);
}

AsyncReader::AsyncReader(std::string_view head, LevelSink &sink, unsigned long baud)
    : CaptureReader(sink), _columns(columnsOf(takeLine(head))) {
  if (_columns.name == None) {
    _analysers.emplace_back(OneAnalyser);
  }
  // At 100000 baud characters begin at least ten bits, 100 us, apart.
  constexpr double FastNs = 90000;
  LineSettings settings;
  std::vector<double> before;
  while (!head.empty()) {
    Row row;
    const std::string_view line = takeLine(head);
    if (head.empty() && !_analysers.empty() && !before.empty()) {
      break;  // the last line may be cut off
    }
    splitRow(line, ',', _fields);
    if (_columns.name != None && _fields.size() > _columns.name &&
        std::find(_analysers.begin(), _analysers.end(), _fields[_columns.name]) == _analysers.end()) {
      _analysers.emplace_back(_fields[_columns.name]);
    }
    before.resize(_analysers.size(), -HUGE_VAL);
    if (!read(line, row).empty() || !row.isData) {
      continue;
    }
    settings.baud = row.ns - before[row.analyser] < FastNs ? 2 * sbus::Baud : settings.baud;
    before[row.analyser] = row.ns;
  }
  _bitNs = baud > 0 ? 1e9 / static_cast<double>(baud) : static_cast<double>(settings.bitNs());
  _wires.resize(_analysers.size());
  _sink.fromCharacters();
  _sink.signals(_analysers);
}

std::string AsyncReader::put(std::string_view lines) {
  std::string error;
  while (!lines.empty() && error.empty()) {
    const std::string_view line = takeLine(lines);
    Row row;
    error = _lines++ == 0 || trimmed(line).empty() ? "" : read(line, row);
    if (error.empty() && row.isData) {
      error = tell(row);
    }
  }
  return error;
}

std::string AsyncReader::read(std::string_view line, Row &row) {
  splitRow(line, ',', _fields);
  _fields.resize(std::max(_columns.count, _fields.size()));  // a row may lack empty fields at its end
  row.isData = _columns.type == None || _fields[_columns.type] == "data";
  if (!row.isData) {
    return {};
  }
  const std::string_view name = _columns.name == None ? OneAnalyser : _fields[_columns.name];
  const auto analyser = std::find(_analysers.begin(), _analysers.end(), name);
  if (analyser == _analysers.end()) {
    return quoted(name) + " has no row among the first ones: a table of one analyser is expected";
  }
  row.analyser = static_cast<size_t>(analyser - _analysers.begin());
  const std::string wrong = _columns.time.read(_fields, row.ns);
  if (!wrong.empty()) {
    return wrong;
  }
  const std::string_view value = _fields[_columns.value];
  if (!parseByte(value, _columns.isDsView ? 16 : 10, row.value)) {
    row.isData = !_columns.isDsView;  // a start bit, a warning
    if (_columns.isDsView) {
      return {};
    }
    return quoted(value) + " is not a byte: export the table with hexadecimal values, such as 0x0F";
  }
  const auto field = [this](size_t column) { return column == None ? std::string_view() : _fields[column]; };
  row.parityWrong = field(_columns.error) == "parity" || !field(_columns.parity).empty();
  row.stopWrong = field(_columns.error) == "framing" || !field(_columns.framing).empty();
  return {};
}

// Emits the levels of a start bit, data, parity and two stop bits; with a framing error the first stop bit is wrong.
std::string AsyncReader::tell(const Row &row) {
  const int64_t startNs = std::llround(row.ns);
  const unsigned parity = static_cast<unsigned>(isOdd(row.value) != row.parityWrong);
  const unsigned stop = row.stopWrong ? 2 : 3;
  const unsigned bits = (stop << 9 | parity << 8 | row.value) << 1;
  Wire &wire = _wires[row.analyser];
  if (wire.startNs == INT64_MIN) {
    wire.changedNs = startNs - std::llround(_bitNs);
    _sink.level(row.analyser, wire.changedNs, false);
  }
  if (startNs < wire.startNs) {
    return "a time is before that of a row above: times in order are expected";
  }
  wire.startNs = startNs;
  bool high = false;
  for (int i = 0; i < 12; i++) {
    const bool active = (bits >> i & 1) == 0;
    if (active != high) {
      wire.changedNs = std::max<int64_t>(wire.changedNs, startNs + std::llround(i * _bitNs));
      _sink.level(row.analyser, wire.changedNs, active);
      high = active;
    }
  }
  _endNs = std::max<int64_t>(_endNs, startNs + std::llround(12 * _bitNs));
  return {};
}

}  // namespace line
