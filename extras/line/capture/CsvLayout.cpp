#include "line/capture/CsvLayout.h"

#include <algorithm>
#include <cmath>

#include "line/capture/Capture.h"
#include "line/capture/Parsing.h"
#include "line/recording/WallTime.h"

namespace line {

namespace {

constexpr size_t RowsMax = 2000;                 // rows of the head to examine
constexpr std::string_view Separators = ";\t,";  // with another separator, a comma is a decimal point

// What the rows do not hold, by the name that instruments give it. The value is beside the name, below it, or behind :
// or =.
enum class What { Rate, Period, Start, Names };
constexpr struct {
  std::string_view name;
  What what;
} Facts[] = {
    {"samplerate", What::Rate},   // PulseView: "; Samplerate: 1 MHz"
    {"sample rate", What::Rate},  // DSView, WaveForms
    {"channels (", What::Names},  // PulseView, DSView: "; Channels (2/8): D0, D1"
    {"interval", What::Period},   // OWON: "Time interval:,0.50000us"; Tektronix, Siglent
    {"xinc", What::Period},       // Keysight Infiniium: "XInc:,1E-06", "XOrg:,-5E-03", then volts alone
    {"xorg", What::Start},
    {"tinc", What::Period},  // Rigol DHO: "CH1V,t0 =-5.0e-04,tInc =1.0e-06"
    {"t0", What::Start},
    {"increment", What::Period},  // Rigol DS1000Z: "X,CH1,Start,Increment" above "Sequence,Volt,-5e-03,1e-06"
    {"start", What::Start},
};

bool isLogic(std::string_view field) {
  return field.size() == 1 && std::string_view("01xXzZ").find(field.front()) != std::string_view::npos;
}

bool isNumber(std::string_view field) {
  double value;
  return parseNumber(field, value);
}

// Reads a date as Saleae's Logic 2 writes it, 2023-06-07T20:59:59.001500000+00:00, in ns since 1970.
bool parseDate(std::string_view field, int64_t &ns) {
  constexpr size_t Seconds = 19;  // characters up to them
  if (field.size() <= Seconds || field[10] != 'T') {
    return false;
  }
  const size_t end = std::min(field.find_first_not_of("0123456789", Seconds + 1), field.size());
  std::string digits(field.substr(Seconds + 1, end - Seconds - 1));
  digits.resize(9, '0');
  int64_t us = 0, rest = 0;
  const bool is = parseWallTime(std::string(field.substr(0, Seconds + 1)) + digits.substr(0, 6) + "Z", us);
  parseWhole(std::string_view(digits).substr(6), rest);
  ns = us * 1000 + rest;
  return is;
}

bool isValue(std::string_view field) {
  int64_t ns;
  return field.empty() || isLogic(field) || isNumber(field) || parseDate(field, ns);
}

bool isRow(const Fields &fields) {
  return std::all_of(fields.begin(), fields.end(), isValue) && std::any_of(fields.begin(), fields.end(), isNumber);
}

// A single # is a column's title. META is a line of sigrok-cli.
bool isComment(std::string_view line) {
  const bool isAlone = line.size() > 1 && Separators.find(line[1]) != std::string_view::npos;
  return line.substr(0, 2) == ",#" || line.substr(0, 5) == "META " ||
         (!line.empty() && (line.front() == ';' || (line.front() == '#' && !isAlone)));
}

// Returns true for a unit, as oscilloscopes write it below a channel's name.
bool isUnit(std::string_view field) {
  return field.empty() || unitIn(field) > 0 || hasWord(field, {"sequence", "v", "mv", "volt", "volts"});
}

// Returns true for names. All but the first may be numbers of channels.
bool areTitles(const Fields &fields) {
  return !fields.empty() && !isNumber(fields.front()) &&
         std::all_of(fields.begin(), fields.end(), [](std::string_view field) {
           return !isNumber(field) || (field.size() <= 2 && std::all_of(field.begin(), field.end(), isDigit));
         });
}

bool isTime(std::string_view title) { return hasWord(title, {"time"}) || unitIn(title) > 0; }

// The lines before the rows.
struct Header {
  std::vector<std::string> titles;  // the columns'
  std::vector<std::string> units;   // from a row below the titles
  std::vector<std::string> names;   // the signals', from a comment
  double startNs = 0;
  double periodNs = 0;
  std::string program;  // "PulseView" or "DSView"; empty: another program

  // Takes what is called so. Returns true if it is a number that stands for something.
  bool take(std::string_view name, std::string_view value) {
    const std::string small = lower(name);
    const auto *const fact = std::find_if(std::begin(Facts), std::end(Facts), [&small](const auto &each) {
      return small.find(each.name) != std::string::npos;
    });
    const char *at = value.data(), *const end = at + value.size();
    double number = 0;
    if (fact == std::end(Facts)) {
      return false;
    }
    if (fact->what == What::Rate) {
      const double ns = periodOf(value);
      periodNs = ns > 0 ? ns : periodNs;
    } else if (fact->what == What::Names) {
      Fields fields;
      splitRow(value, ',', fields);
      names.assign(fields.begin(), fields.end());
    } else if (takeNumber(at, end, number) && isUnit({at, static_cast<size_t>(end - at)})) {
      double &ns = fact->what == What::Start ? startNs : periodNs;
      ns = fact->what == What::Start || number > 0 ? number * unitOf(value) : ns;
      return true;
    }
    return false;
  }

  void comment(std::string_view line) {
    const std::string small = lower(line);
    // DSView is derived from sigrok, and its header says so up to version 1.1; its times are in seconds.
    const bool isDsView = small.find("dsview") != std::string::npos || small.find("sigrok4dsl") != std::string::npos;
    program = isDsView                                                       ? "DSView"
              : program.empty() && small.find("sigrok") != std::string::npos ? "PulseView"
                                                                             : program;
    const size_t colon = line.find(": ");
    if (colon != std::string_view::npos) {
      take(line.substr(0, colon), line.substr(colon + 2));
    }
  }

  void row(const Fields &fields) {
    for (size_t i = 1; i < fields.size() && !take(fields.front(), fields[i]); i++) {
    }
    for (const std::string_view field : fields) {
      const size_t equals = std::min(field.find('='), field.size());
      take(field.substr(0, equals), trimmed(field.substr(std::min(equals + 1, field.size()))));
    }
    const bool inBrackets = !fields.empty() && fields.front().substr(0, 1) == "(";
    const bool areUnits = fields.size() == titles.size() && std::all_of(fields.begin(), fields.end(), isUnit);
    if (!titles.empty() && (inBrackets || areUnits)) {
      units.assign(fields.begin(), fields.end());
    } else if (areTitles(fields)) {
      titles.assign(fields.begin(), fields.end());
      units.clear();
    } else {
      for (size_t i = 0; i < titles.size() && i < fields.size(); i++) {
        take(titles[i], fields[i]);
      }
    }
  }

  // Returns a column's title and unit.
  std::string title(size_t column) const {
    return (column < titles.size() ? titles[column] : "") + " " + (column < units.size() ? units[column] : "");
  }

  // Keysight: before its first sample, a row has a time alone.
  bool isTimeAlone(const Fields &fields) const {
    return titles.size() > 1 && !units.empty() && isTime(units.front()) && isRow(fields) &&
           std::all_of(fields.begin() + 1, fields.end(), [](std::string_view each) { return each.empty(); });
  }
};

// Finds the first rows, and reads the lines before them. All rows have the same number of fields; it needs two rows, if
// the file has two.
std::vector<Fields> takeRows(std::string_view head, CsvLayout &layout, Header &header) {
  std::vector<Fields> rows;
  for (uint64_t lines = 0; !head.empty() && rows.size() < RowsMax; lines++) {
    const std::string_view line = takeLine(head);
    Fields fields;
    splitRow(line, layout.separator, fields);
    if (fields.empty() || (rows.empty() && header.isTimeAlone(fields))) {
      continue;
    }
    const bool isOne = !isComment(line) && isRow(fields);
    if (!rows.empty() && !(isOne && fields.size() == rows.front().size())) {
      if (rows.size() > 1) {
        break;
      }
      header.row(rows.front());
      rows.clear();
    }
    if (isOne) {
      layout.headLines = rows.empty() ? lines : layout.headLines;
      rows.push_back(fields);
    } else {
      isComment(line) ? header.comment(line) : header.row(fields);
    }
  }
  return rows;
}

char separatorOf(std::string_view head) {
  size_t lines[Separators.size()] = {};
  bool areExponents = true;  // ngspice's wrdata puts blanks between numbers such as 1.00999000e-03
  while (!head.empty()) {
    const std::string_view line = takeLine(head);
    std::string_view words = line;
    for (std::string_view word = takeWord(words); !word.empty() && areExponents && !head.empty();
         word = takeWord(words)) {
      areExponents = isNumber(word) && word.find('e') != word.npos;
    }
    for (size_t i = 0; i < Separators.size(); i++) {
      lines[i] += line.find(Separators[i]) != std::string_view::npos;
    }
  }
  const auto *const most = std::max_element(lines, lines + Separators.size());
  return *most == 0 && areExponents ? ' ' : Separators[static_cast<size_t>(most - lines)];
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

std::vector<CsvSignal> signalsOf(const Header &header, const std::vector<size_t> &columns) {
  std::vector<CsvSignal> signals;
  for (const size_t column : columns) {
    const std::string name = header.names.size() == columns.size() ? header.names[signals.size()]
                             : column < header.titles.size()       ? header.titles[column]
                                                                   : "";
    const bool isTaken =
        std::any_of(signals.begin(), signals.end(), [&name](const CsvSignal &each) { return each.name == name; });
    signals.push_back({name.empty() || isTaken ? std::to_string(column + 1) : name, column});
  }
  return signals;
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

// Finds the columns of the times and of the signals.
void takeColumns(const std::vector<Fields> &rows, const Header &header, CsvLayout &layout) {
  std::vector<size_t> columns;
  for (size_t i = 0; i < rows.front().size(); i++) {
    if (!rows.front()[i].empty()) {
      columns.push_back(i);
    }
  }
  const auto title = [&](size_t i) { return header.title(columns[i]); };
  // A column that counts the rows may precede the times, or replace them.
  const bool isCounted = columns.size() > 1 && !isTime(title(0)) && grows(rows, columns[0], true);
  if (isCounted) {
    columns.erase(columns.begin());
  }
  // Saleae's Logic MSO: "Trigger [s]" begins again with each waveform, "Time [s]" goes on.
  while (columns.size() > 2 && isTime(title(0)) && !hasWord(title(0), {"time"}) && hasWord(title(1), {"time"})) {
    columns.erase(columns.begin());
  }
  if (columns.size() > 1 && (isTime(title(0)) || (!isCounted && grows(rows, columns[0], false)))) {
    layout.time.column = columns[0];
    const bool isSigrok = header.program == "PulseView" && header.periodNs > 0;
    layout.time.unitNs = isSigrok ? sigrokUnitNs(header.periodNs) : unitOf(title(0));
    parseDate(rows.front()[columns[0]], layout.time.zeroNs);
    columns.erase(columns.begin());
  }
  layout.signals = signalsOf(header, columns);
}

bool areVoltages(const std::vector<Fields> &rows, const std::vector<CsvSignal> &signals) {
  return std::any_of(rows.begin(), rows.end(), [&signals](const Fields &row) {
    return std::any_of(signals.begin(), signals.end(), [&row](const CsvSignal &each) {
      return each.column < row.size() && !row[each.column].empty() && !isLogic(row[each.column]);
    });
  });
}

// Measures the time between two rows, each a sample: the mean, unless a simulator has sampled more often at the edges.
void measurePeriod(const std::vector<Fields> &rows, CsvLayout &layout) {
  std::vector<double> times, periods;
  for (const Fields &row : rows) {
    double ns;
    if (layout.time.read(row, ns).empty()) {
      times.push_back(ns);
    }
  }
  for (size_t i = 1; i < times.size(); i++) {
    periods.push_back(times[i] - times[i - 1]);
  }
  if (!periods.empty()) {
    const double mean = (times.back() - times.front()) / static_cast<double>(periods.size());
    const auto often = periods.begin() + static_cast<std::ptrdiff_t>(periods.size() / 10);
    std::nth_element(periods.begin(), often, periods.end());
    layout.periodNs = *often > 0 && *often < mean / 2 ? *often : mean;
  }
}

}  // namespace

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

double unitIn(std::string_view text) {
  return hasWord(text, {"s", "sec", "second", "seconds"})       ? 1e9
         : hasWord(text, {"ms", "millisecond", "milliseconds"}) ? 1e6
         : hasWord(text, {"us", "microsecond", "microseconds"}) ? 1e3
         : hasWord(text, {"ns", "nanosecond", "nanoseconds"})   ? 1
         : hasWord(text, {"ps"})                                ? 1e-3
         : hasWord(text, {"fs"})                                ? 1e-6
                                                                : 0;
}

double unitOf(std::string_view title) {
  const double ns = unitIn(title);
  return ns > 0 ? ns : 1e9;
}

std::string TimeColumn::read(const Fields &fields, double &ns) const {
  const std::string_view field = column < fields.size() ? fields[column] : "";
  int64_t date = 0;
  if (parseDate(field, date)) {
    ns = static_cast<double>(date - zeroNs);
  } else if (parseNumber(field, ns, decimalMark)) {
    ns *= unitNs;
  } else {
    return quoted(field) + " is not a time: a number is expected in column " + std::to_string(column + 1);
  }
  return std::abs(ns) <= static_cast<double>(CaptureTimeMaxNs) ? "" : "a time is beyond a year: is its unit right?";
}

std::string findLayout(std::string_view head, CsvLayout &layout, double periodNs) {
  layout.separator = separatorOf(head);
  std::string points(head);
  if (layout.separator != ',') {
    layout.time.decimalMark = ',';
    std::replace(points.begin(), points.end(), ',', '.');
  }
  Header header;
  const std::vector<Fields> rows = takeRows(points, layout, header);
  if (rows.empty()) {
    return "is not a known capture of a wire: VCD, or CSV of Saleae Logic 2, PulseView, DSView or an oscilloscope is "
           "expected";
  }
  takeColumns(rows, header, layout);
  TimeColumn &time = layout.time;
  if (periodNs > 0) {
    header.periodNs = periodNs;
    time.column = TimeColumn::None;
  }
  if (time.column == TimeColumn::None && header.periodNs <= 0) {
    return "does not say when its samples were taken: a column of times, or a comment such as \"; Samplerate: 1 MHz\", "
           "or --sample-rate is expected";
  }
  layout.startNs = header.startNs;
  layout.periodNs = header.periodNs;
  layout.analogue = areVoltages(rows, layout.signals);
  if (time.column != TimeColumn::None && layout.analogue && rows.size() > 1) {
    measurePeriod(rows, layout);
  }
  layout.name = !header.program.empty() ? header.program + " CSV"
                : layout.analogue       ? OscilloscopeFormat
                                        : "logic analyser's CSV";
  return {};
}

}  // namespace line
