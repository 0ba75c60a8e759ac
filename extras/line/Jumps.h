// Finds jumps: a channel that leaves its course for one frame, as a sender makes that changes the channels while it
// sends.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>

namespace line {

// In a jump a channel's value differs from that of the frame before and of the frame after by least() or more, to the
// same side, and these two by at most half as much.
class Jumps {
 public:
  // Returns the smallest jump, raw, if the frame before and the one after are that far apart: 100, and 3/4 for each
  // square of a millisecond: 243 at a period of 9 ms, 1200 at 20 ms. A hand that moves a stick over its whole travel
  // and back in 150 ms turns it by less, even if the radio sends only every second of the frames a new value.
  static constexpr uint64_t least(uint64_t apartUs) {
    return std::max<uint64_t>(100, apartUs * apartUs / 1000 * 3 / 4000);
  }

  // Takes the next frame. `areSticks`: its values are not those of a failsafe. Returns the channels that have jumped in
  // the frame before, bit 0 for CH1.
  template <typename Value>
  uint32_t put(uint64_t us, const Value *channels, size_t count, bool areSticks) {
    Frame frame;
    frame.us = us;
    frame.count = areSticks ? std::min(count, frame.raw.size()) : 0;
    std::transform(channels, channels + frame.count, frame.raw.begin(),
                   [](Value raw) { return static_cast<int>(raw); });
    uint32_t jumped = 0;
    const bool areSame = frame.count == _before.count && frame.count == _newest.count;
    for (size_t i = 0; areSame && i < frame.count; i++) {
      const int there = _newest.raw[i] - _before.raw[i], back = _newest.raw[i] - frame.raw[i];
      const int jump = std::min(std::abs(there), std::abs(back));
      if (static_cast<uint64_t>(jump) >= least(us - _before.us) && 2 * std::abs(there - back) <= jump) {
        jumped |= uint32_t{1} << i;
      }
    }
    _before = _newest;
    _newest = frame;
    return jumped;
  }

 private:
  struct Frame {
    uint64_t us = 0;
    size_t count = 0;  // 0: it has no values of sticks
    std::array<int, 32> raw{};
  };

  Frame _before;  // the one before the newest
  Frame _newest;
};

}  // namespace line
