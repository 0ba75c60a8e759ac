#include "CsvColumns.h"

#include <cmath>
#include <cstdlib>

namespace host {

namespace {

constexpr size_t LineMax = 1024;   // what follows on a line is not read
constexpr size_t ColumnsMax = 64;  // nor are further columns

}  // namespace

void CsvColumns::put(const uint8_t *bytes, size_t size) {
  for (size_t i = 0; i < size; i++) {
    if (bytes[i] == '\n') {
      endLine();
    } else if (bytes[i] != '\r' && _line.size() < LineMax) {
      _line += static_cast<char>(bytes[i]);
    }
  }
}

void CsvColumns::endLine() {
  _lines++;
  size_t begin = 0;
  for (size_t column = 0; column < ColumnsMax; column++) {
    const size_t comma = _line.find(',', begin);
    lookAt(column, _line.substr(begin, comma - begin));
    if (comma == std::string::npos) {
      break;
    }
    begin = comma + 1;
  }
  _line.clear();
}

void CsvColumns::lookAt(size_t column, const std::string &field) {
  if (_columns.size() <= column) {
    _columns.resize(column + 1);
  }
  char *end = nullptr;
  const double value = std::strtod(field.c_str(), &end);
  if (field.empty() || *end != '\0' || !std::isfinite(value)) {
    return;
  }
  Range &range = _columns[column];
  if (!range.any || value < range.low) {
    range.low = value;
    range.lowText = field;
  }
  if (!range.any || value > range.high) {
    range.high = value;
    range.highText = field;
  }
  range.any = true;
}

}  // namespace host
