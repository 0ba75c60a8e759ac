// Counts a sketch's lines, and keeps the range of the numbers in each column.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "line/recording/CsvRows.h"

namespace host {

class CsvColumns {
 public:
  struct Range {
    bool any = false;  // false: no numbers in this column
    double low = 0;
    double high = 0;
    std::string lowText;  // as printed
    std::string highText;
  };

  void put(const uint8_t *bytes, size_t size);

  unsigned long lines() const { return _lines; }
  const std::vector<Range> &columns() const { return _columns; }

 private:
  void lookAt(size_t column, const line::CsvField &field);

  line::CsvRows _rows;
  unsigned long _lines = 0;
  std::vector<Range> _columns;
};

}  // namespace host
