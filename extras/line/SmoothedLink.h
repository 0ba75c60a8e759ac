// The state of the link for a human reader: single lost frames do not change it, and brief events are shown for long
// enough to be seen.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>

#include "sbus/Frame.h"
#include "sbus/Link.h"

namespace line {

class SmoothedLink {
 public:
  static constexpr uint64_t HoldUs = 200000;  // how long a lost frame or a failsafe is shown

  // Takes the flags of the next frame or row and the link's state with it. `knownUs`: when it was received; a port
  // delivers frames late.
  void frame(uint64_t us, uint8_t flags, sbus::LinkState link, uint64_t knownUs) {
    const bool lost = (flags & sbus::FlagLostFrame) != 0;
    const bool counts = lost && (flags & sbus::FlagFailsafe) == 0;  // after a failsafe the link is good at once
    _second.push_back({us, counts});
    _lost += counts;
    while (_second.front().us + SecondUs <= us) {
      _lost -= _second.front().lost;
      _second.pop_front();
    }
    const bool isAll = _lost == _second.size();
    _isLossy = isAll || (_isLossy ? _lost * FinePart >= _second.size()
                                  : _lost * LossyPart > std::max(_second.size(), FramesMin));
    _newestLost = lost;
    _newestFailsafe = link == sbus::LinkState::Failsafe;
    const uint64_t untilUs = std::max(us, knownUs) + HoldUs;
    _lostUntilUs = lost ? untilUs : _lostUntilUs;
    _failsafeUntilUs = _newestFailsafe ? untilUs : _failsafeUntilUs;
  }

  // Returns the state to show, given sbus::Link's at `nowUs`. It becomes lossy if more than 1/12 of the last second's
  // frames were lost, or all, and remains so until fewer than 1/32 are.
  sbus::LinkState state(sbus::LinkState link, uint64_t nowUs) const {
    if (link != sbus::LinkState::Ok && link != sbus::LinkState::Lossy) {
      return link;
    }
    return showsFailsafe(nowUs) ? sbus::LinkState::Failsafe : _isLossy ? sbus::LinkState::Lossy : sbus::LinkState::Ok;
  }

  // Returns the number of frames or rows within the last second.
  unsigned perSecond(uint64_t nowUs) const {
    return static_cast<unsigned>(std::count_if(_second.begin(), _second.end(), [nowUs](const Arrival &came) {
      return came.us + SecondUs > nowUs && came.us <= nowUs;
    }));
  }

  // Return what the indicators show: the newest frame, or one shortly before it, was lost or in failsafe.
  bool showsLostFrame(uint64_t nowUs) const { return _newestLost || nowUs < _lostUntilUs; }
  bool showsFailsafe(uint64_t nowUs) const { return _newestFailsafe || nowUs < _failsafeUntilUs; }

 private:
  static constexpr uint64_t SecondUs = 1000000;
  static constexpr size_t LossyPart = 12;  // below the 1/10 of sbus::Diagnosis: the link never looks better than that
  static constexpr size_t FinePart = 32;
  static constexpr size_t FramesMin = 30;  // so that a line's first lost frame does not make it lossy

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
