#include "line/recording/CsvRows.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "line/recording/Words.h"

namespace line {

namespace {

constexpr size_t LineMax = 1024;
constexpr size_t ColumnsMax = 64;
constexpr size_t LeastColumns = 2;
constexpr size_t LeastText = 4;  // characters: fewer between two 0A occur by chance

// strtod() would also take "0x1F" and "inf".
bool isNumber(const std::string &text) {
  return !text.empty() && text.find_first_not_of("0123456789+-.eE") == std::string::npos;
}

CsvField fieldOf(std::string_view text) {
  CsvField field;
  const size_t colon = text.find(':');
  if (colon != std::string_view::npos) {
    field.name = withoutBlanks(text.substr(0, colon));
    text.remove_prefix(colon + 1);
  }
  field.text = withoutBlanks(text);
  char *end = nullptr;
  field.value = std::strtod(field.text.c_str(), &end);
  field.isNumber = isNumber(field.text) && *end == '\0' && std::isfinite(field.value);
  return field;
}

constexpr struct {
  const char *name;
  CsvKind kind;
} Names[] = {{"failsafe", CsvKind::Failsafe},
             {"lostframe", CsvKind::LostFrame},
             {"switch17", CsvKind::Switch17},
             {"switch18", CsvKind::Switch18}};

CsvKind kindOf(const std::string &text) {
  const std::string name = lower(text);
  const auto *const known =
      std::find_if(std::begin(Names), std::end(Names), [&](const auto &each) { return name == each.name; });
  return known == std::end(Names) ? CsvKind::Channel : known->kind;
}

constexpr size_t FlagColumns = 6;     // examples/DecodeSBus
constexpr size_t SwitchColumns = 18;  // examples/AllChannels

bool mayHaveFlags(size_t columns) {
  return columns == FlagColumns || columns == SwitchColumns;
}

}  // namespace

LineSettings csvSettings() {
  LineSettings settings;
  settings.baud = 115200;
  settings.format = {8, Parity::None, 1};
  settings.polarity = Polarity::Either;
  return settings;
}

bool CsvRows::put(uint8_t byte) {
  const bool ended = byte == '\n' && _returned;
  _returned = byte == '\r';
  if (ended) {
    return false;
  }
  if (byte == '\n' || byte == '\r') {
    endLine();
    return true;
  }
  const bool isText = byte == '\t' || (byte >= ' ' && byte <= '~');
  if (!isText) {
    _text = false;
    _garbled++;
    _recognised = false;
  } else if (_line.size() < LineMax) {
    _line += static_cast<char>(byte);
  }
  return false;
}

CsvKind CsvRows::kind(size_t column) const {
  const size_t columns = _row.size();
  if (!_row[column].name.empty()) {
    return kindOf(_row[column].name);
  }
  if (_names.size() == columns) {
    return kindOf(_names[column].text);
  }
  if (!_hasFlags || !mayHaveFlags(columns) || column + 2 < columns) {
    return CsvKind::Channel;
  }
  const bool isLast = column + 1 == columns;
  return columns == FlagColumns ? (isLast ? CsvKind::LostFrame : CsvKind::Failsafe)
                                : (isLast ? CsvKind::Switch18 : CsvKind::Switch17);
}

// Splits at commas; without any at tabs; otherwise at blanks.
void CsvRows::split() {
  _row.clear();
  std::string_view rest = withoutBlanks(_line);
  const bool commas = rest.find(',') != std::string_view::npos;
  const bool tabs = rest.find('\t') != std::string_view::npos;
  _isTable = commas || rest.find(':') != std::string_view::npos;
  while (_row.size() < ColumnsMax) {
    if (!commas && !tabs) {
      rest.remove_prefix(std::min(rest.find_first_not_of(' '), rest.size()));
      if (rest.empty() && !_row.empty()) {
        break;
      }
    }
    const size_t end = rest.find(commas ? ',' : tabs ? '\t' : ' ');
    _row.push_back(fieldOf(rest.substr(0, end)));
    if (end == std::string_view::npos) {
      break;
    }
    rest.remove_prefix(end + 1);
  }
}

void CsvRows::endLine() {
  // Where numbers have decimal commas, a spreadsheet separates them by semicolons or tabs.
  const auto has = [this](const char *text) { return _line.find(text) != std::string::npos; };
  if (has(";") || (has("\t") && !has(",\t"))) {
    std::replace(_line.begin(), _line.end(), ',', '.');
    std::replace(_line.begin(), _line.end(), ';', ',');
  }
  split();
  _isRow = _text && std::all_of(_row.begin(), _row.end(), [](const CsvField &field) { return field.isNumber; });
  _isText = _text && _line.size() >= LeastText;
  const size_t columns = _isRow ? _row.size() : 0;
  if (_isText && !_isRow) {
    _names = _row;
  }
  if (columns != _columns) {
    _hasFlags = true;
  }
  for (size_t i = mayHaveFlags(columns) ? columns - 2 : columns; i < columns; i++) {
    _hasFlags = _hasFlags && (_row[i].value == 0 || _row[i].value == 1);
  }
  _recognised = columns >= LeastColumns && columns == _columns;
  _columns = columns;
  _line.clear();
  _text = true;
}

}  // namespace line
