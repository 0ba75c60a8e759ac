#include "CsvColumns.h"

namespace host {

void CsvColumns::put(const uint8_t *bytes, size_t size) {
  for (size_t i = 0; i < size; i++) {
    if (!_rows.put(bytes[i])) {
      continue;
    }
    _lines++;
    for (size_t column = 0; column < _rows.row().size(); column++) {
      lookAt(column, _rows.row()[column]);
    }
  }
}

void CsvColumns::lookAt(size_t column, const line::CsvField &field) {
  if (_columns.size() <= column) {
    _columns.resize(column + 1);
  }
  if (!field.isNumber) {
    return;
  }
  Range &range = _columns[column];
  if (!range.any || field.value < range.low) {
    range.low = field.value;
    range.lowText = field.text;
  }
  if (!range.any || field.value > range.high) {
    range.high = field.value;
    range.highText = field.text;
  }
  range.any = true;
}

}  // namespace host
