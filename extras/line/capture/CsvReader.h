// Reads the rows of a capture's CSV: a logic analyser's, with one row for each sample or change, or an oscilloscope's.
#pragma once

#include "line/capture/Capture.h"
#include "line/capture/CsvLayout.h"
#include "line/capture/Threshold.h"

namespace line {

// The common part of both readers: rows, and their times.
class CsvReader : public CaptureReader {
 public:
  CsvReader(CsvLayout layout, LevelSink &sink);

  std::string put(std::string_view lines) override;
  std::string format() const override { return _layout.name; }
  int64_t endNs() override;

 protected:
  // Takes rows with their LF, and counts them in _lines.
  virtual std::string rows(std::string_view text) = 0;

  // Reads the time of the next row. Returns what is wrong, or nothing.
  std::string rowTime(std::string_view row, int64_t &ns);

  CsvLayout _layout;
  Fields _fields;
  uint64_t _row = 0;  // number of the next row, from 0
  bool _hasTime = false;  // a row's time was read
  std::string _last;      // the last good row
};

class DigitalReader : public CsvReader {
 public:
  using CsvReader::CsvReader;

 private:
  std::string rows(std::string_view text) override;
  std::string changed(std::string_view row);

  std::string _values;  // the previous row without its time
};

class AnalogueReader : public CsvReader {
 public:
  // `threshold`: for all signals; without it, one is found for each signal.
  AnalogueReader(CsvLayout layout, LevelSink &sink, std::optional<double> threshold);

  bool needsFullBlocks() const override { return !_isGiven; }

 private:
  struct Signal {
    AnalogueLevel level;
    std::vector<double> volts;  // of the current rows
  };

  std::string rows(std::string_view text) override;
  std::string takeVolts(std::string_view row);

  const bool _isGiven;  // the threshold was given
  std::vector<Signal> _signals;
  std::vector<std::string_view> _rows;  // the current ones
};

}  // namespace line
