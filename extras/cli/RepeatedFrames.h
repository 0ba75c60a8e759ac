// Sends the same values, or the newest row of a slow table, as a frame every period, like a receiver.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "line/file/TableReader.h"
#include "cli/TextLine.h"
#include "line/Line.h"

namespace tool {

class RepeatedFrames : public line::Line {
 public:
  // Sends these values for ever.
  RepeatedFrames(const line::FrameValues &values, uint64_t periodUs, uint32_t characterUs)
      : _periodUs(periodUs), _characterUs(characterUs) {
    _row.values = values;
  }

  // Sends the rows of a table from `fromUs` to `toUs` in its own time; 0: to its end. Messages call it `name`.
  RepeatedFrames(std::string name, std::unique_ptr<TextInput> text, uint64_t periodUs, uint32_t characterUs,
                 uint64_t fromUs, uint64_t toUs);

  bool next(uint64_t nowUs, line::Character &character) override;
  bool finished(uint64_t nowUs) const override { return _ended && _waiting.empty() && nowUs >= _frameUs; }
  std::string failure() const override { return _waiting.empty() ? _failure : ""; }

 private:
  void makeFrame();
  void goTo(uint64_t us);
  void readRow();
  bool readLine(std::string &line);

  const std::string _name;
  const std::unique_ptr<TextLines> _lines;  // null: the values stay
  const uint64_t _periodUs;
  const uint32_t _characterUs;
  line::TableRows _table;
  line::TableRow _row;                    // the row to send
  std::optional<line::TableRow> _newRow;  // the row to send from _newUs on
  uint64_t _newUs = 0;
  uint64_t _zeroUs = 0;  // the time of the first row
  uint64_t _endUs = 0;   // when the last row ends
  unsigned long _rows = 0;
  uint64_t _frameUs = 0;  // when the next frame begins
  uint64_t _toUs = 0;
  bool _ended = false;
  std::deque<line::Character> _waiting;
  std::string _failure;
};

}  // namespace tool
