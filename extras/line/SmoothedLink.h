// The state of the link for a human reader: single lost frames do not change it, and brief events are shown for long
// enough to be seen.
#pragma once

#include <cstdint>
#include <deque>

#include "sbus/Link.h"

namespace line {

class SmoothedLink {
 public:
  static constexpr uint64_t HoldUs = 200000;  // how long a lost frame or a failsafe is shown

  // Takes the flags of the next frame or row and the link's state with it. `knownUs`: when it was received; a port
  // delivers frames late.
  void frame(uint64_t us, uint8_t flags, sbus::LinkState link, uint64_t knownUs);

  // Returns the state to show, given sbus::Link's at `nowUs`. It becomes lossy if more than 1/12 of the last second's
  // frames were lost, or all, and remains so until fewer than 1/32 are.
  sbus::LinkState state(sbus::LinkState link, uint64_t nowUs) const;

  // Returns the number of frames or rows within the last second.
  unsigned perSecond(uint64_t nowUs) const;

  // Return what the indicators show: the newest frame, or one shortly before it, was lost or in failsafe.
  bool showsLostFrame(uint64_t nowUs) const { return _newestLost || nowUs < _lostUntilUs; }
  bool showsFailsafe(uint64_t nowUs) const { return _newestFailsafe || nowUs < _failsafeUntilUs; }

 private:
  struct Arrival {
    uint64_t us;
    bool lost;  // without failsafe
  };

  std::deque<Arrival> _second;  // frames of the last second
  size_t _lost = 0;             // of these
  bool _isLossy = false;
  bool _newestLost = false;
  bool _newestFailsafe = false;
  uint64_t _lostUntilUs = 0;
  uint64_t _failsafeUntilUs = 0;
};

}  // namespace line
