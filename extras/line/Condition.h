// A condition on a line, as `sbus watch --when` and the page's trigger take it:
//
//   failsafe || ch5 > 1500us && !(age > 50 ms)
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "line/Observer.h"

namespace line {

// The line at a time: after a frame, after a board's row, after bytes that are neither, or in the silence after them.
struct Moment {
  // What has a value; the channels come first.
  enum Which : uint8_t { ChannelsEnd = 32, Age = ChannelsEnd, Quality, State, Failsafe, LostFrame, Rejected, Count };

  // Takes the values of an observer. `isRejected`: of the newest stretch.
  Moment(Observer &observer, uint64_t nowUs, bool isRejected);

  // Takes the channels: raw, or as a board prints them.
  template <typename Value>
  void setChannels(const Value *channels, unsigned count) {
    for (unsigned i = 0; i < ChannelsEnd; i++) {
      values[i] = i < count ? static_cast<double>(channels[i]) : std::numeric_limits<double>::quiet_NaN();
    }
  }

  double values[Count];  // not a number: there is no such channel
};

// Returns true for bytes that are neither a frame nor telemetry.
inline bool isRejected(const Stretch &stretch) {
  return !stretch.isFrame() && stretch.slots.empty();
}

class Condition {
 public:
  // Returns a raw value of a channel, counted from 0, as it is shown in percent, or in microseconds.
  using Shown = std::function<double(unsigned channel, uint16_t raw, bool isPercent)>;

  struct Error {
    std::string text;   // "a time is expected"; "": there is no error
    size_t at = 0;      // where, in bytes
    size_t length = 0;  // of what is wrong; 0 at the end
  };

  // Tests a value, or joins the results of the steps before it. The last result is the condition's.
  struct Step {
    enum Joining : uint8_t { Not = Moment::Count, And, Or };

    uint8_t which;  // Moment::Which or Joining
    double low = 0;
    double high = 0;
    bool outside = false;  // the value must not be in low..high
  };

  // Reads a text. A channel's us and percent are compared as they are shown; raw values are 0 to 2047, unless the line
  // may be that of a board. Without `shown` it is: its numbers are compared as it prints them.
  Condition(std::string_view text, const Shown &shown, bool maybeBoard = false);

  // Makes a copy of another memory's.
  Condition(const Step *begin, const Step *end) : _steps(begin, end) {}

  const Error &error() const { return _error; }
  const std::vector<Step> &steps() const { return _steps; }

  // Returns true if it may become true while nothing comes.
  bool needsTime() const;

  // Returns false before the first frame or rejected bytes.
  bool holds(const Moment &moment) const;

 private:
  Error _error;
  std::vector<Step> _steps;
};

}  // namespace line
