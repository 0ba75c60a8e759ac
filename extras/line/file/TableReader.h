// Reads rows of CSV, as printed by `sbus csv`, as frames.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "line/file/LineReader.h"
#include "line/file/Units.h"
#include "line/LineSettings.h"
#include "line/Statistics.h"
#include "line/recording/CsvRows.h"
#include "sbus/Frame.h"

namespace line {

constexpr size_t TableChannelMax = 32;

// The values of a frame. CH3 starts at its low end, throttle off, like the failsafe of the paper's R-XSR.
struct FrameValues : Values {
  FrameValues() {
    raw.fill(992);
    raw[2] = 172;
  }
};

// Sets a value: "ch3=172", "ch3=1500us", "ch5=on" or "failsafe=on". Returns what is wrong with the word, or nothing.
std::string assign(const std::string &word, const sbus::Range &range, FrameValues &values);

struct TableRow {
  std::optional<int64_t> us;
  FrameValues values;
  bool hasFirst = false;  // one of CH1 to CH16
  bool hasRest = false;   // one of CH17 and above, if these are channels
};

// Takes the lines of a table, the first of which has the names of its columns.
class TableRows {
 public:
  // Takes the next line. Returns what is wrong with it, or nothing. Afterwards isRow() tells whether it was a row.
  std::string line(std::string_view text);

  // Takes the last line, if it has no LF. A row is wrong, since the text may be cut within it: 99 of 992 is a value
  // too.
  std::string cutLine(std::string_view text);

  bool isRow() const { return _isRow; }
  const TableRow &row() const { return _row; }

  // Returns the number of the highest channel: 16 to 18, 24 or 32 in a whole table; less in others.
  size_t channels() const { return _channels; }
  // Returns true if all channels up to the highest and the time have a column.
  bool isWhole() const;

 private:
  enum class Kind { Time, Channel, Switch, Failsafe, LostFrame, Ignored };
  struct Column {
    Kind kind = Kind::Ignored;
    size_t index = 0;
  };

  static bool parseName(const std::string &text, Column &column);
  bool takeNames();
  std::string takeRow(const CsvRow &fields);
  std::string takeField(const Column &column, const CsvField &field);
  std::string takeTime(const CsvField &field);

  CsvRows _parser;
  std::vector<Column> _columns;
  size_t _channels = 0;
  TableRow _row;
  std::optional<int64_t> _lastUs;
  bool _isRow = false;
};

// Appends the frames for a row of `channels` channels to `characters`. The last one ends at `endUs`, or later if the
// line is busy until `lastUs`. Returns its end.
uint64_t appendFrames(const TableRow &row, size_t channels, uint64_t endUs, uint64_t lastUs, uint32_t characterUs,
                      std::deque<Character> &characters);

// Makes a frame of each row of a whole table.
class TableReader : public FrameReader {
 public:
  explicit TableReader(const LineSettings &settings) : FrameReader(settings.characterUs()) {}

  std::string line(std::string_view text, std::deque<Character> &characters) override;
  std::string cutLine(std::string_view text, std::deque<Character> & /*characters*/) override {
    return _rows.cutLine(text);
  }
  std::string finish(std::deque<Character> & /*characters*/) override {
    return _any ? "" : "has no rows; rows as sbus csv prints them are expected";
  }

 private:
  TableRows _rows;
};

// Whether a text is a whole table with a row per frame: rows at most 50 ms apart. Maybe: it has fewer than two rows
// yet.
enum class FrameTable { No, Maybe, Yes };

// Finds that out by the whole lines at the text's beginning.
FrameTable frameTable(std::string_view head);

}  // namespace line
