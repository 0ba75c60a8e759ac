#include "line/recording/CsvRows.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>

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
             {"ch17", CsvKind::Switch17},
             {"ch18", CsvKind::Switch18}};

CsvKind kindOf(const std::string &name) {
  const auto *const known =
      std::find_if(std::begin(Names), std::end(Names), [&](const auto &each) { return name == each.name; });
  return known == std::end(Names) ? CsvKind::Channel : known->kind;
}

constexpr size_t FlagColumns = 6;     // examples/DecodeSBus
constexpr size_t SwitchColumns = 18;  // examples/AllChannels

bool mayHaveFlags(size_t columns) { return columns == FlagColumns || columns == SwitchColumns; }

}  // namespace

std::string withCommas(std::string_view row) {
  std::string text(withoutBlanks(row));
  const size_t separator = text.find(text.find(';') == std::string::npos ? '\t' : ';');
  if (separator == std::string::npos) {
    return text;
  }
  const char mark = text[separator];
  for (size_t i = 0; i < text.size(); i++) {
    const bool isDecimal =
        text[i] == ',' && i > 0 && isDigit(text[i - 1]) && i + 1 < text.size() && isDigit(text[i + 1]);
    text[i] = isDecimal ? '.' : text[i] == ',' ? ' ' : text[i] == mark ? ',' : text[i];
  }
  return text;
}

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
  const bool isNamed = !_row[column].name.empty();
  if (isNamed || _names.size() == columns) {
    const auto nameOf = [isNamed](const CsvField &field) { return lower(isNamed ? field.name : field.text); };
    const CsvRow &names = isNamed ? _row : _names;
    const CsvKind kind = kindOf(nameOf(names[column]));
    const bool isSwitch = kind == CsvKind::Switch17 || kind == CsvKind::Switch18;
    const auto isCh19 = [&](const CsvField &field) { return nameOf(field) == "ch19"; };  // then these two are channels
    return isSwitch && std::any_of(names.begin(), names.end(), isCh19) ? CsvKind::Channel : kind;
  }
  if (!_hasFlags || !mayHaveFlags(columns) || column + 2 < columns) {
    return CsvKind::Channel;
  }
  const bool isLast = column + 1 == columns;
  return columns == FlagColumns ? (isLast ? CsvKind::LostFrame : CsvKind::Failsafe)
                                : (isLast ? CsvKind::Switch18 : CsvKind::Switch17);
}

// Splits at commas, semicolons or tabs; without any at blanks.
void CsvRows::split() {
  _row.clear();
  const std::string plain = withCommas(_line);
  Fields cells;
  splitRow(plain, plain.find(',') == std::string::npos ? ' ' : ',', cells, ' ');
  if (plain.empty() || plain.back() == ',') {
    cells.emplace_back();
  }
  cells.resize(std::min(cells.size(), ColumnsMax));
  std::transform(cells.begin(), cells.end(), std::back_inserter(_row), fieldOf);
}

void CsvRows::endLine() {
  split();
  const bool hasLong =
      std::any_of(_row.begin() + 1, _row.end(), [](const CsvField &field) { return field.text.size() > 2; });
  _isTable = _line.find_first_of(",;:") != std::string::npos || (hasLong && _line.find('\t') != std::string::npos);
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
