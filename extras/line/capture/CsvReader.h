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
  bool needsFullBlocks() const override { return _layout.analogue && !_isGiven; }

 private:
  struct Signal {
    AnalogueLevel level;
    std::vector<double> values;  // of the current rows: volts, or 0 and 1; NaN if unknown
  };

  std::string take(std::string_view row);
  std::string takeTime();

  const CsvLayout _layout;
  const bool _isGiven;  // the threshold was given
  std::vector<Signal> _signals;
  std::vector<int64_t> _times;  // of the current rows
  Fields _fields;               // of a row
  std::vector<double> _row;     // its values
  uint64_t _number = 0;         // of the next row
};

}  // namespace line
