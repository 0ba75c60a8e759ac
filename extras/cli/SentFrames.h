// The frames of `sbus send`: what is on the command line, or the rows of a CSV.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "line/Line.h"
#include "line/simulation/LineSettings.h"
#include "sbus/Frame.h"

namespace tool {

// The values of a frame. CH3 is at its low end until it is set, as in the failsafe of the paper's R-XSR: throttle off.
struct FrameValues {
  std::array<uint16_t, sbus::ChannelCount> channels = {992, 992, 172, 992, 992, 992, 992, 992, 992,
                                                       992, 992, 992, 992, 992, 992, 992, 0,   0};
  bool failsafe = false;
  bool lostFrame = false;
};

// Sets the value that "ch3=172", "ch5=on" or "failsafe=on" names. Throws std::runtime_error.
void assign(const std::string &word, FrameValues &values);

// The values that frames hold from a time on.
struct TimedValues {
  uint64_t us;
  FrameValues values;
};

struct TimedRows {
  std::vector<TimedValues> rows;
  uint64_t endUs = 0;  // the last one holds until then
};

// Reads rows as `sbus csv` writes them: with a header any of its columns, without one those that it prints by default.
// The column time counts from the first row; without this column rows come every 0.2 s. Throws std::runtime_error,
// which names the line.
TimedRows readTimedRows(const std::string &name);

// Sends the newest row as a frame every `periodUs`, until the rows end; without end if `endUs` is 0.
class FrameLine : public line::Line {
 public:
  FrameLine(TimedRows rows, uint64_t periodUs, const line::LineSettings &settings)
      : _rows(std::move(rows)), _periodUs(periodUs), _characterUs(settings.characterUs()) {}

  bool next(uint64_t nowUs, line::Character &character) override;
  bool finished(uint64_t nowUs) const override { return ended() && nowUs >= _frameUs; }

 private:
  void beginFrame();
  // Returns true if all frames have been sent, the last one whole.
  bool ended() const { return _rows.endUs > 0 && _frameUs >= _rows.endUs; }

  const TimedRows _rows;
  const uint64_t _periodUs;
  const uint64_t _characterUs;
  size_t _row = 0;
  uint64_t _frameUs = 0;  // when the frame begins
  size_t _index = 0;      // of its next character
  uint8_t _frame[sbus::FrameSize] = {};
};

}  // namespace tool
