#include "CsvRows.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace line {

namespace {

constexpr size_t LineMax = 1024;
constexpr size_t ColumnsMax = 64;
constexpr size_t LeastColumns = 2;
constexpr size_t LeastText = 4;  // characters: fewer between two 0A come by chance

// strtod() would take "0x1F" and "inf", too.
bool isNumber(const std::string &text) {
  return !text.empty() && text.find_first_not_of(" 0123456789+-.eE") == std::string::npos;
}

CsvField fieldOf(std::string text) {
  CsvField field;
  char *end = nullptr;
  field.value = std::strtod(text.c_str(), &end);
  field.isNumber = isNumber(text) && *end == '\0' && std::isfinite(field.value);
  field.text = std::move(text);
  return field;
}

}  // namespace

std::string csvName(size_t column, size_t columns) {
  constexpr size_t SketchColumns = 6;
  if (columns == SketchColumns && column >= SketchColumns - 2) {
    return column == SketchColumns - 1 ? "lostFrame" : "failsafe";
  }
  return "CH" + std::to_string(column + 1);
}

LineSettings csvSettings() {
  LineSettings settings;
  settings.baud = 115200;
  settings.format = {8, Parity::None, 1};
  settings.polarity = Polarity::Either;
  return settings;
}

bool CsvRows::put(uint8_t byte) {
  if (byte == '\n') {
    endLine();
    return true;
  }
  const bool isText = byte == '\r' || byte == '\t' || (byte >= ' ' && byte <= '~');
  if (!isText) {
    _text = false;
    _recognised = false;
  } else if (byte != '\r' && _line.size() < LineMax) {
    _line += static_cast<char>(byte);
  }
  return false;
}

void CsvRows::endLine() {
  _row.clear();
  for (size_t begin = 0; begin != std::string::npos && _row.size() < ColumnsMax;) {
    const size_t comma = _line.find(',', begin);
    _row.push_back(fieldOf(_line.substr(begin, comma - begin)));
    begin = comma == std::string::npos ? comma : comma + 1;
  }
  _isRow = _text && std::all_of(_row.begin(), _row.end(), [](const CsvField &field) { return field.isNumber; });
  _isText = _text && _line.size() >= LeastText;
  const size_t columns = _isRow ? _row.size() : 0;
  _recognised = columns >= LeastColumns && columns == _columns;
  _columns = columns;
  _line.clear();
  _text = true;
}

}  // namespace line
