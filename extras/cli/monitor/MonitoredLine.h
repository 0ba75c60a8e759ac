// Watches a line for `sbus monitor`: takes its characters, and returns the view to show.
#pragma once

#include <vector>

#include "cli/monitor/MonitorView.h"
#include "line/LineSettings.h"
#include "line/Observer.h"
#include "line/recording/CsvRows.h"
#include "line/telemetry/Readings.h"

namespace tool {

class MonitoredLine {
 public:
  // `hasTimes`: the times are the line's; without them it shows neither rates nor gaps. `range`, `pulses`: see
  // MonitorView.
  MonitoredLine(const std::string &source, bool hasTimes, const line::LineSettings &settings, const sbus::Range &range,
                const sbus::Range &pulses, const line::SensorsBySlot &sensors);
  MonitoredLine(const MonitoredLine &) = delete;  // its observer's listener points to it
  MonitoredLine &operator=(const MonitoredLine &) = delete;

  void put(const line::Character &character);
  void idleUntil(uint64_t nowUs) { _observer.idleUntil(nowUs); }

  // Takes the news that the port is gone, or back.
  void news(const std::string &text, uint64_t nowUs);

  // Resets marks and counters; keeps the link's state.
  void reset();

  MonitorView view(uint64_t nowUs);

  // Returns the state and the newest values as a JSON line. `zeroUs`: the source's own time at time 0.
  std::string json(uint64_t nowUs, int64_t zeroUs);

 private:
  struct Column {
    double low = 0;
    double high = 0;
  };

  void take(const line::Stretch &stretch);
  void takeRow(uint64_t endUs);
  bool rowIsRaw() const;
  void showFrames(MonitorView &view, uint64_t nowUs);
  void showState(MonitorView &view, uint64_t nowUs);
  void showRows(MonitorView &view, uint64_t nowUs) const;
  MonitorView::Group telemetry(uint64_t nowUs) const;
  std::vector<MonitorView::Group> groups(uint64_t nowUs, bool seen) const;

  const std::string _source;
  const bool _hasTimes;
  const line::LineSettings _settings;
  const sbus::Range _range;
  const sbus::Range _pulses;

  line::Observer _observer;
  line::Readings _readings;
  sbus::Counters _before{};  // at the last reset
  unsigned long _errorsBefore = 0;
  unsigned long _discardedBefore = 0;
  uint64_t _characterUs = 0;  // when the newest one ended

  line::CsvRows _rows;
  bool _isCsv = false;
  line::CsvRow _row;  // the newest
  std::vector<Column> _columns;
  bool _wasRaw = true;  // all rows so far had raw values
  uint64_t _rowUs = 0;
  line::Extent _rowGaps;

  std::string _news;
  uint64_t _newsUs = 0;
};

}  // namespace tool
