// The state of the link as a person can follow it: single lost frames do not change it, and what lasted a moment is
// shown for long enough to be seen.
#pragma once

#include <cstdint>
#include <deque>

#include "sbus/Link.h"

namespace line {

class HeldLink {
 public:
  static constexpr uint64_t HoldUs = 200000;  // for which a lost frame and a failsafe are shown

  // Takes the next frame or row: its flags, and the link's state at it. It came by `knownUs`: a port brings frames
  // late.
  void frame(uint64_t us, uint8_t flags, sbus::LinkState link, uint64_t knownUs);

  // Returns the state to show, if `link` is that of sbus::Link at `nowUs`. Lossy: of the frames of the last second more
  // than 1/12 were lost, or all, and since then not less than 1/32.
  sbus::LinkState state(sbus::LinkState link, uint64_t nowUs) const;

  // Returns how many came within the last second.
  unsigned perSecond(uint64_t nowUs) const;

  // Return what the indicators show: that the newest frame is lost, or in failsafe, or that one shortly before was.
  bool showsLostFrame(uint64_t nowUs) const { return _newestLost || nowUs < _lostUntilUs; }
  bool showsFailsafe(uint64_t nowUs) const { return _newestFailsafe || nowUs < _failsafeUntilUs; }

 private:
  struct Came {
    uint64_t us;
    bool lost;  // without failsafe
  };

  std::deque<Came> _second;  // frames of the last second
  size_t _lost = 0;          // of these
  bool _isLossy = false;
  bool _newestLost = false;
  bool _newestFailsafe = false;
  uint64_t _lostUntilUs = 0;
  uint64_t _failsafeUntilUs = 0;
};

}  // namespace line
