// Reads the rows of a capture's CSV: a logic analyser's, with one row for each sample or change, or an oscilloscope's.
#pragma once

#include "line/capture/Capture.h"
#include "line/capture/CsvLayout.h"
#include "line/capture/Threshold.h"

namespace line {

class CsvReader : public CaptureReader {
 public:
  // `threshold`: for all voltages; without it, one is found for each signal.
  CsvReader(CsvLayout layout, LevelSink &sink, std::optional<double> threshold);

  std::string put(std::string_view lines) override;
  std::string format() const override { return _layout.name; }
  int64_t endNs() override;
  bool needsFullBlocks() const override { return _layout.analogue && !_isGiven; }

 private:
  struct Signal {
    AnalogueLevel level;
    std::vector<double> values;  // of the current rows: volts, or 0 and 1; NaN if unknown
  };
  struct Row {
    std::string_view text;
    uint64_t number;  // from 0
    uint64_t line;
  };

  bool isRepeated(std::string_view row) const;
  std::string take(std::string_view row);
  std::string takeValue(const char *at, const char *end, size_t column, double &value) const;
  std::string tellLevels();
  std::string timeOf(std::string_view row, uint64_t number, int64_t &ns);

  CsvLayout _layout;
  const bool _isGiven;  // the threshold was given
  std::vector<Signal> _signals;
  std::vector<Row> _rows;  // the current ones that are not repeated
  Fields _fields;
  uint64_t _number = 0;   // of the next row
  bool _hasTime = false;  // a row's time was read
  std::string _before;    // a row of levels that was read, without its time
  std::string _last;      // the last good row
};

}  // namespace line
