#include "line/capture/CsvLayout.h"

#include <algorithm>
#include <cmath>

#include "line/capture/Capture.h"
#include "line/capture/Parsing.h"

namespace line {

namespace {

constexpr size_t RowsMax = 2000;  // rows of the head to examine

// The lines before the rows.
struct Header {
  std::vector<std::string> titles;  // the columns'
  std::vector<std::string> units;   // from a row below the titles
  std::vector<std::string> names;   // the signals', from a comment
  double startNs = 0;
  double periodNs = 0;
  std::string program;  // "PulseView" or "DSView"; empty: another program

  void comment(std::string_view line);
  void row(const Fields &fields);
};

// "; Samplerate: 1 MHz", "; Channels (2/8): D0, D1"
void Header::comment(std::string_view line) {
  const std::string small = lower(line);
  // DSView is derived from sigrok, and its header says so up to version 1.1; its times are in seconds.
  const bool dsView = small.find("dsview") != std::string::npos || small.find("sigrok4dsl") != std::string::npos;
  program = dsView ? "DSView" : program.empty() && small.find("sigrok") != std::string::npos ? "PulseView" : program;
  const size_t colon = line.find(": ");
  if (colon == std::string_view::npos) {
    return;
  }
  const std::string_view value = line.substr(colon + 2);
  if (small.find("samplerate:") != std::string::npos || small.find("sample rate:") != std::string::npos) {
    periodNs = periodOf(value);
  } else if (small.find("channels (") != std::string::npos) {
    Fields fields;
    splitRow(value, ',', fields);
    names.assign(fields.begin(), fields.end());
  }
}

void Header::row(const Fields &fields) {
  // OWON writes the time between two rows next to "Time interval".
  for (size_t i = 1; i < fields.size() && hasWord(fields.front(), {"interval"}); i++) {
    const char *at = fields[i].data();
    double value;
    if (takeNumber(at, at + fields[i].size(), value) && value > 0) {
      periodNs = value * unitOf(fields[i]);
      break;
    }
  }
  // Rigol's DHO writes them next to the channel's name: "t0 =-5.0e-04", "tInc =1.0e-06".
  for (const std::string_view field : fields) {
    const size_t equals = field.find('=');
    double seconds;
    if (equals != std::string_view::npos && parseNumber(trimmed(field.substr(equals + 1)), seconds)) {
      const std::string name = lower(trimmed(field.substr(0, equals)));
      startNs = name == "t0" ? seconds * 1e9 : startNs;
      periodNs = name == "tinc" && seconds > 0 ? seconds * 1e9 : periodNs;
    }
  }
  const bool inBrackets = !fields.empty() && fields.front().substr(0, 1) == "(";
  if (!titles.empty() &&
      (inBrackets || (fields.size() == titles.size() && std::all_of(fields.begin(), fields.end(), isUnit)))) {
    units.assign(fields.begin(), fields.end());
    return;
  }
  if (isTitles(fields)) {
    titles.assign(fields.begin(), fields.end());
    units.clear();
    return;
  }
  // Rigol writes the first row's time and the time between two rows under "Start" and "Increment".
  for (size_t i = 0; i < titles.size() && i < fields.size(); i++) {
    double seconds;
    if (parseNumber(fields[i], seconds)) {
      startNs = hasWord(titles[i], {"start"}) ? seconds * 1e9 : startNs;
      periodNs = hasWord(titles[i], {"increment"}) && seconds > 0 ? seconds * 1e9 : periodNs;
    }
  }
}

bool isTime(std::string_view title) {
  return hasWord(title, {"time", "s", "sec", "second", "seconds"}) || unitOf(title) != 1e9;
}

// Finds the first rows, and reads the lines before them. All rows have the same number of fields; it needs two rows, if
// the file has two.
std::vector<Fields> takeRows(std::string_view head, CsvLayout &layout, Header &header) {
  std::vector<Fields> rows;
  uint64_t lines = 0;
  while (!head.empty() && rows.size() < RowsMax) {
    const std::string_view line = takeLine(head);
    Fields fields;
    splitRow(line, layout.separator, fields);
    // Keysight: before its first sample, a row has a time alone.
    const bool isAlone = rows.empty() && !fields.empty() && header.titles.size() > 1 && !header.units.empty() &&
                         isTime(header.units.front()) && isRow(fields) &&
                         std::all_of(fields.begin() + 1, fields.end(), [](std::string_view each) { return each.empty(); });
    if (fields.empty() || isAlone) {
      lines++;
      continue;
    }
    const bool isOne = !isComment(line) && isRow(fields);
    const bool fits = isOne && (rows.empty() || fields.size() == rows.front().size());
    if (rows.size() > 1 && !fits) {
      break;
    }
    if (rows.size() == 1 && !fits) {
      header.row(rows.front());
      rows.clear();
    }
    if (isOne) {
      layout.headLines = rows.empty() ? lines : layout.headLines;
      rows.push_back(fields);
    } else if (isComment(line)) {
      header.comment(line);
    } else {
      header.row(fields);
    }
    lines++;
  }
  return rows;
}

char separatorOf(std::string_view head) {
  size_t lines[Separators.size()] = {};
  for (size_t row = 0; row < RowsMax && !head.empty(); row++) {
    const std::string_view line = takeLine(head);
    for (size_t i = 0; i < Separators.size(); i++) {
      lines[i] += line.find(Separators[i]) != std::string_view::npos;
    }
  }
  return Separators[static_cast<size_t>(std::max_element(lines, lines + Separators.size()) - lines)];
}

// Returns true if each value is greater than the previous one; by one, if the column `counts`.
bool grows(const std::vector<Fields> &rows, size_t column, bool counts) {
  double before = 0;
  for (size_t i = 0; i < rows.size(); i++) {
    double value;
    if (column >= rows[i].size() || !parseNumber(rows[i][column], value) ||
        (i > 0 && (counts ? value != before + 1 : value <= before))) {
      return false;
    }
    before = value;
  }
  return rows.size() > 2;
}

std::vector<std::string> namesOf(const Header &header, const std::vector<size_t> &columns) {
  std::vector<std::string> names;
  for (size_t i = 0; i < columns.size(); i++) {
    std::string name = header.names.size() == columns.size() ? header.names[i]
                       : columns[i] < header.titles.size()   ? header.titles[columns[i]]
                                                             : "";
    if (name.empty() || std::find(names.begin(), names.end(), name) != names.end()) {
      name = std::to_string(columns[i] + 1);
    }
    names.push_back(name);
  }
  return names;
}

// sigrok counts whole units from sample to sample, and drops the rest: 41 ns at 24 MHz. The unit is a second divided by
// the smallest power of 1000 that is not below the rate.
double sigrokUnitNs(double periodNs) {
  const double rate = 1e9 / periodNs;
  double units = 1;
  while (units < rate) {
    units *= 1000;
  }
  return periodNs / std::floor(units / rate);
}

}  // namespace

bool CsvLayout::timeOf(std::string_view field, double &ns) const {
  int64_t timestampNs;
  if (parseNumber(field, ns, decimalMark)) {
    ns *= timeUnitNs;
  } else if (parseTimestamp(field, timestampNs)) {
    ns = static_cast<double>(timestampNs - zeroNs);
  } else {
    return false;
  }
  return true;
}

std::string findLayout(std::string_view head, CsvLayout &layout, double periodNs) {
  layout.separator = separatorOf(head);
  std::string points(head);
  if (layout.separator != ',') {
    layout.decimalMark = ',';
    std::replace(points.begin(), points.end(), ',', '.');
    head = points;
  }
  Header header;
  const std::vector<Fields> rows = takeRows(head, layout, header);
  if (rows.empty()) {
    return "is not a known capture of a wire: VCD, CSV of Saleae Logic 2, PulseView, DSView or an oscilloscope, "
           "or bits as 0 and 1 are expected";
  }
  for (size_t i = 0; i < rows.front().size(); i++) {
    if (!rows.front()[i].empty()) {
      layout.columns.push_back(i);
    }
  }
  const auto title = [&header](size_t column) {
    return (column < header.titles.size() ? header.titles[column] : "") + " " +
           (column < header.units.size() ? header.units[column] : "");
  };
  // A column that counts the rows may precede the times, or replace them.
  size_t first = layout.columns.front();
  const bool counted = layout.columns.size() > 1 && !isTime(title(first)) && grows(rows, first, true);
  if (counted) {
    layout.columns.erase(layout.columns.begin());
    first = layout.columns.front();
  }
  // Saleae's Logic MSO: "Trigger [s]" begins again with each waveform, "Time [s]" goes on.
  while (layout.columns.size() > 2 && isTime(title(first)) && !hasWord(title(first), {"time"}) &&
         hasWord(title(layout.columns[1]), {"time"})) {
    layout.columns.erase(layout.columns.begin());
    first = layout.columns.front();
  }
  if (layout.columns.size() > 1 && (isTime(title(first)) || (!counted && grows(rows, first, false)))) {
    layout.columns.erase(layout.columns.begin());
    layout.timeColumn = first;
    layout.timeUnitNs =
        header.program == "PulseView" && header.periodNs > 0 ? sigrokUnitNs(header.periodNs) : unitOf(title(first));
    parseTimestamp(rows.front()[first], layout.zeroNs);
  }
  if (periodNs > 0) {
    header.periodNs = periodNs;
    layout.timeColumn = CsvLayout::None;
  }
  if (layout.timeColumn == CsvLayout::None && header.periodNs <= 0) {
    return "does not say when its samples were taken: a column of times, or a comment such as \"; Samplerate: 1 MHz\", "
           "or --sample-rate is expected";
  }
  layout.startNs = header.startNs;
  layout.periodNs = header.periodNs;
  for (const Fields &row : rows) {
    for (const size_t column : layout.columns) {
      layout.analogue = layout.analogue || (column < row.size() && !row[column].empty() && !isLogic(row[column]));
    }
  }
  double begin, end;
  if (layout.timeColumn != CsvLayout::None && (layout.analogue || counted) && rows.size() > 1 &&
      layout.timeOf(rows.front()[layout.timeColumn], begin) && layout.timeOf(rows.back()[layout.timeColumn], end)) {
    layout.periodNs = std::abs(end - begin) / static_cast<double>(rows.size() - 1);  // each row is a sample
    layout.startNs = end < begin ? -begin : begin;  // OWON's times go back, its samples do not
    layout.timeColumn = counted ? CsvLayout::None : layout.timeColumn;
  }
  layout.names = namesOf(header, layout.columns);
  layout.name = !header.program.empty() ? header.program + " CSV"
                : layout.analogue       ? OscilloscopeFormat
                                        : "logic analyser's CSV";
  return {};
}

}  // namespace line
