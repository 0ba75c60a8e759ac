#include "line/SmoothedLink.h"

#include <algorithm>

#include "sbus/Frame.h"

namespace line {

namespace {

constexpr uint64_t SecondUs = 1000000;
constexpr size_t LossyPart =
    12;  // below the 1/10 at which sbus::Diagnosis says lossy, so the link never looks better than its diagnosis
constexpr size_t FinePart = 32;
constexpr size_t FramesMin = 30;  // so that a line's first lost frame does not make it lossy

}  // namespace

void SmoothedLink::frame(uint64_t us, uint8_t flags, sbus::LinkState link, uint64_t knownUs) {
  const bool lost = (flags & sbus::FlagLostFrame) != 0;
  const bool counts = lost && (flags & sbus::FlagFailsafe) == 0;  // after a failsafe the link is good at once
  _second.push_back({us, counts});
  _lost += counts;
  while (_second.front().us + SecondUs <= us) {
    _lost -= _second.front().lost;
    _second.pop_front();
  }
  const bool isAll = _lost == _second.size();
  _isLossy = isAll ||
             (_isLossy ? _lost * FinePart >= _second.size() : _lost * LossyPart > std::max(_second.size(), FramesMin));
  _newestLost = lost;
  _newestFailsafe = link == sbus::LinkState::Failsafe;
  const uint64_t untilUs = std::max(us, knownUs) + HoldUs;
  _lostUntilUs = lost ? untilUs : _lostUntilUs;
  _failsafeUntilUs = _newestFailsafe ? untilUs : _failsafeUntilUs;
}

sbus::LinkState SmoothedLink::state(sbus::LinkState link, uint64_t nowUs) const {
  if (link != sbus::LinkState::Ok && link != sbus::LinkState::Lossy) {
    return link;
  }
  return showsFailsafe(nowUs) ? sbus::LinkState::Failsafe : _isLossy ? sbus::LinkState::Lossy : sbus::LinkState::Ok;
}

unsigned SmoothedLink::perSecond(uint64_t nowUs) const {
  return static_cast<unsigned>(std::count_if(_second.begin(), _second.end(), [nowUs](const Arrival &came) {
    return came.us + SecondUs > nowUs && came.us <= nowUs;
  }));
}

}  // namespace line
