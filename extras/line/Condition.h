// A condition on a line, for `sbus watch --when` and the page's trigger:
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

// The line at a moment: after a frame, a board's row, or other bytes, or in the silence after them.
struct Moment {
  // The values; the channels come first.
  enum Which : uint8_t {
    ChannelsEnd = 32,
    Age = ChannelsEnd,
    Quality,
    State,
    Failsafe,
    NoPulses,
    LostFrame,
    Rejected,
    Jump,
    Count
  };

  Moment() : values{} {}

  // Takes an observer's values. `isRejected`: the newest stretch is.
  Moment(Observer &observer, uint64_t nowUs, bool isRejected);

  // Takes the channels: raw values, or a board's numbers.
  template <typename Value>
  void setChannels(const Value *channels, unsigned count) {
    for (unsigned i = 0; i < ChannelsEnd; i++) {
      values[i] = i < count ? static_cast<double>(channels[i]) : std::numeric_limits<double>::quiet_NaN();
    }
  }

  double values[Count];  // NaN: no such channel
};

// Returns true for bytes that are neither a frame nor telemetry.
inline bool isRejected(const Stretch &stretch) { return !stretch.isFrame() && stretch.slots.empty(); }

class Condition {
 public:
  // Returns the value shown, in percent or microseconds, for a channel, counted from 0, and its raw value.
  using Shown = std::function<double(unsigned channel, uint16_t raw, bool isPercent)>;

  struct Error {
    std::string text;   // "a time is expected"; "": no error
    size_t at = 0;      // position in bytes
    size_t length = 0;  // of the wrong part; 0 at the end
  };

  // Tests a value, or combines the results of earlier steps. The last result is the condition's.
  struct Step {
    enum Joining : uint8_t { Not = Moment::Count, And, Or };

    uint8_t which;  // Moment::Which or Joining
    double low = 0;
    double high = 0;
    bool outside = false;  // the value must not be in low..high
  };

  // Reads a text. A channel's us and percent are compared as shown; raw values are 0 to 2047, unless the line may be a
  // board's. Without `shown` it is a board's, and numbers are compared as printed.
  Condition(std::string_view text, const Shown &shown, bool maybeBoard = false);

  // Copies the steps of a condition in another memory.
  Condition(const Step *begin, const Step *end) : _steps(begin, end) {}

  const Error &error() const { return _error; }
  const std::vector<Step> &steps() const { return _steps; }

  // Returns true if the condition may become true while the line is silent.
  bool needsTime() const;

  // Returns false before the first frame or rejected bytes.
  bool holds(const Moment &moment) const;

 private:
  Error _error;
  std::vector<Step> _steps;
};

}  // namespace line
