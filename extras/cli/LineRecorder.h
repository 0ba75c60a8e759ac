// Saves a line as a recording, or a sketch's rows as CSV, for `record` and `monitor`.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cli/Output.h"
#include "line/Observer.h"
#include "line/recording/CsvRows.h"
#include "line/recording/RecordingWriter.h"

namespace tool {

// Holds the characters back until it is clear whether they are S.Bus or a sketch's rows. A copy of a recording is
// always a recording with the same times, even of rows.
class LineRecorder {
 public:
  // Passes the text to `write`. The file's first comment is "sbus " and `title`. `isCopy`: of a recording. Without
  // `hasTimes` a comment says that the times are not the line's; with `startUs` another gives the date of time 0.
  // `zeroUs`: see line::RecordingWriter::setZero().
  LineRecorder(const std::string &title, const line::LineSettings &settings, bool isCopy, bool hasTimes,
               std::optional<int64_t> startUs, int64_t zeroUs, const Put &write);

  void put(const line::Character &character);

  // Takes the time up to which there are no further characters, and writes those received so far.
  void idleUntil(uint64_t us);

  // Writes the rest. Call it after the last character.
  void finish();

  // Returns true once there were frames or rows.
  bool recognised() const { return _rows.recognised() || _observer.counters().frames > 0; }

  // Returns "1000 characters (0 with errors), 40 frames".
  std::string summary();

 private:
  enum class Kind { Unknown, Characters, Rows };

  void decide();
  void begin(Kind kind);
  void writeRow(bool complete);
  void flush();

  const std::string _title;
  const line::LineSettings _settings;
  const bool _hasTimes;
  const std::optional<int64_t> _startUs;
  const Put &_write;
  line::RecordingWriter _writer;
  line::Observer _observer;
  line::CsvRows _rows;
  Kind _kind = Kind::Unknown;
  std::vector<line::Character> _first;
  uint64_t _lastEndUs = 0;
  size_t _columns = 0;
  unsigned long _rowCount = 0;
};

}  // namespace tool
