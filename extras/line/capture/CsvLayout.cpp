#include "line/capture/CsvLayout.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "line/capture/Capture.h"
#include "line/capture/Text.h"

namespace line {

namespace {

using Fields = std::vector<std::string_view>;

constexpr size_t RowsMax = 2000;  // of the head, that are looked at

constexpr std::string_view Separators = ";\t,";  // a comma beside another one is a decimal point

// A # that stands alone is a column's title.
bool isComment(std::string_view line) {
  const bool alone = line.size() > 1 && Separators.find(line[1]) != std::string_view::npos;
  return !line.empty() && (line.front() == ';' || (line.front() == '#' && !alone));
}

// 0, 1 or unknown.
bool isLogic(std::string_view field) {
  return field.size() == 1 && std::string_view("01xXzZ").find(field.front()) != std::string_view::npos;
}

bool isNumber(std::string_view field) {
  double value;
  return parseNumber(field, value);
}

bool isVoltage(std::string_view field) {
  const char *at = field.data();
  const char *end = at + field.size();
  double volts;
  return (takeNumber(at, end, volts) || takeInfinity(at, end, volts)) && at == end;
}

bool isTimestamp(std::string_view field) {
  int64_t ns;
  return parseTimestamp(field, ns);
}

// Numbers, or nothing; at least one number.
bool isRow(const Fields &fields) {
  const auto fits = [](std::string_view field) {
    return field.empty() || isLogic(field) || isVoltage(field) || isTimestamp(field);
  };
  return std::all_of(fields.begin(), fields.end(), fits) && std::any_of(fields.begin(), fields.end(), isNumber);
}

// True if one of the words of `text`, in lower case, is one of `words`. A micro sign, in whatever encoding, is a u.
bool hasWord(std::string_view text, std::initializer_list<std::string_view> words) {
  std::string word;
  for (const char c : lower(text) + ' ') {
    if (c >= 'a' && c <= 'z') {
      word += c;
    } else if (!isAscii(c)) {
      word = "u";
    } else if (std::find(words.begin(), words.end(), word) != words.end()) {
      return true;
    } else {
      word.clear();
    }
  }
  return false;
}

double unitOf(std::string_view title) {
  return hasWord(title, {"ns", "nanosecond", "nanoseconds"})     ? 1
         : hasWord(title, {"us", "microsecond", "microseconds"}) ? 1e3
         : hasWord(title, {"ms", "millisecond", "milliseconds"}) ? 1e6
                                                                 : 1e9;
}

// A unit as oscilloscopes write it below a channel's name.
bool isUnit(std::string_view field) {
  return field.empty() || hasWord(field, {"sequence", "s", "second", "ms", "us", "ns", "v", "mv", "volt", "volts"});
}

// Names; but for the first one, a channel's may be its number.
bool isTitles(const Fields &fields) {
  const auto isChannel = [](std::string_view field) {
    return !isNumber(field) ||
           (field.size() <= 2 && std::all_of(field.begin(), field.end(), isDigit));
  };
  return !fields.empty() && !isNumber(fields.front()) && std::all_of(fields.begin(), fields.end(), isChannel);
}

// What stands before the rows.
struct Header {
  std::vector<std::string> titles;  // of the columns
  std::vector<std::string> units;   // from a row below the titles
  std::vector<std::string> names;   // of the signals, from a comment
  double startNs = 0;
  double periodNs = 0;
  std::string program;  // "PulseView" or "DSView"; empty: another one

  void comment(std::string_view line);
  void row(const Fields &fields);
};

// "; Samplerate: 1 MHz", "; Channels (2/8): D0, D1"
void Header::comment(std::string_view line) {
  const std::string small = lower(line);
  // DSView was made of sigrok, and has said so in its header up to 1.1; its times are seconds.
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
  // OWON's: "Time interval" stands beside that between two rows.
  for (size_t i = 1; i < fields.size() && hasWord(fields.front(), {"interval"}); i++) {
    const char *at = fields[i].data();
    double value;
    if (takeNumber(at, at + fields[i].size(), value) && value > 0) {
      periodNs = value * unitOf(fields[i]);
      break;
    }
  }
  const bool inBrackets = !fields.empty() && fields.front().substr(0, 1) == "(";
  if (!titles.empty() && (inBrackets || (fields.size() == titles.size() && std::all_of(fields.begin(), fields.end(), isUnit)))) {
    units.assign(fields.begin(), fields.end());
    return;
  }
  if (isTitles(fields)) {
    titles.assign(fields.begin(), fields.end());
    units.clear();
    return;
  }
  // Rigol's: under "Start" and "Increment" stand the first row's time and that between two rows.
  for (size_t i = 0; i < titles.size() && i < fields.size(); i++) {
    double seconds;
    if (parseNumber(fields[i], seconds)) {
      startNs = hasWord(titles[i], {"start"}) ? seconds * 1e9 : startNs;
      periodNs = hasWord(titles[i], {"increment"}) && seconds > 0 ? seconds * 1e9 : periodNs;
    }
  }
}

// The first rows, and what stands before them. They have the same number of fields, and are two at the least, unless
// there is no more.
std::vector<Fields> takeRows(std::string_view head, CsvLayout &layout, Header &header) {
  std::vector<Fields> rows;
  uint64_t lines = 0;
  while (!head.empty() && rows.size() < RowsMax) {
    const std::string_view line = takeLine(head);
    Fields fields;
    splitRow(line, layout.separator, fields);
    if (fields.empty()) {
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

bool isTime(std::string_view title) {
  return hasWord(title, {"time", "s", "sec", "second", "seconds"}) || unitOf(title) != 1e9;
}

// Each is more than the one before; by one, if the column `counts`.
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

// sigrok counts whole units from sample to sample, and cuts off what is left: 41 ns at 24 MHz. The unit is the power of
// 1000 that its rate just does not exceed.
double sigrokUnitNs(double periodNs) {
  const double rate = 1e9 / periodNs;
  double units = 1;
  while (units < rate) {
    units *= 1000;
  }
  return periodNs / std::floor(units / rate);
}

}  // namespace

void splitRow(std::string_view row, char separator, std::vector<std::string_view> &fields) {
  fields.clear();
  while (!row.empty()) {
    const size_t size = row.find(separator);
    fields.push_back(trimmed(row.substr(0, size)));
    row.remove_prefix(size == std::string_view::npos ? row.size() : size + 1);
  }
}

bool takeInfinity(const char *&at, const char *end, double &volts) {
  const char *p = at + (at < end && *at == '-');
  const char *word = p;
  while (p < end && !isAscii(*p)) {
    p++;
  }
  if (p == word) {
    return false;
  }
  volts = at == word ? HUGE_VAL : -HUGE_VAL;
  at = p;
  return true;
}

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
    return "is no capture of a wire that is known: VCD, CSV of Saleae Logic 2, PulseView, DSView or an oscilloscope, or "
           "bits as 0 and 1 are expected";
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
  // Before the times, or instead of them, there may be a column that counts the rows.
  size_t first = layout.columns.front();
  const bool counted = layout.columns.size() > 1 && !isTime(title(first)) && grows(rows, first, true);
  if (counted) {
    layout.columns.erase(layout.columns.begin());
    first = layout.columns.front();
  }
  if (layout.columns.size() > 1 && (isTime(title(first)) || (!counted && grows(rows, first, false)))) {
    layout.columns.erase(layout.columns.begin());
    layout.timeColumn = first;
    layout.timeUnitNs = header.program == "PulseView" && header.periodNs > 0 ? sigrokUnitNs(header.periodNs) : unitOf(title(first));
    parseTimestamp(rows.front()[first], layout.zeroNs);
  }
  if (periodNs > 0) {
    header.periodNs = periodNs;
    layout.timeColumn = CsvLayout::None;
  }
  if (layout.timeColumn == CsvLayout::None && header.periodNs <= 0) {
    return "does not say when its samples were taken: a column of times, or a comment such as \"; Samplerate: 1 MHz\", "
           "or --rate is expected";
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
  layout.name = !header.program.empty() ? header.program + " CSV" : layout.analogue ? OscilloscopeFormat : "logic analyser's CSV";
  return {};
}

}  // namespace line
