#include "LinkQuality.h"

namespace sbus {

namespace {

constexpr uint16_t RateUnit = 256;  // units of _rate in one frame a second
constexpr uint8_t Decay = 6;        // units in 250 ms: 0.1 frames a second, each second

// Most frames with one of the flags have both: so take the larger count, not the sum.
uint32_t badOf(uint32_t lost, uint32_t failsafe) {
  return lost > failsafe ? lost : failsafe;
}

// After begin() the counters are 0 again.
bool isBelow(uint32_t frames, uint32_t before) {
  return static_cast<int32_t>(frames - before) < 0;
}

}  // namespace

uint8_t LinkQuality::update(const Counters &counters, LinkState state, uint32_t now) {
  const Mark mark = {now, counters.frames, counters.lostFrames, counters.failsafeFrames};
  const Mark &oldest = _marks[_count < MarkCount ? 0 : _next];
  if (state == LinkState::NeverSeen || state == LinkState::Stale || _count == 0 ||
      now - oldest.time > uint32_t{LongestTime} * 1000 || isBelow(mark.frames, oldest.frames)) {
    _marks[0] = mark;
    _count = 1;
    _next = 1;
    _rate = 0;
    return state == LinkState::Ok ? 100 : 0;
  }
  const uint32_t ms = (now - oldest.time) / 1000;
  const uint32_t came = mark.frames - oldest.frames;
  const uint32_t bad = badOf(mark.lost - oldest.lost, mark.failsafe - oldest.failsafe);
  const uint32_t good = came > bad ? came - bad : 0;
  if ((now - _marks[(_next + MarkCount - 1) % MarkCount].time) / 1000 >= MarkTime) {
    if (_count == MarkCount) {
      const uint32_t rate = came * RateUnit * 1000 / ms;
      const uint32_t decayed = _rate > Decay ? _rate - Decay : 0;
      _rate = static_cast<uint16_t>(rate > UINT16_MAX ? UINT16_MAX : rate > decayed ? rate : decayed);
    } else {
      _count++;
    }
    _marks[_next] = mark;
    _next = static_cast<uint8_t>((_next + 1) % MarkCount);
  }
  // At one rate, two stretches of equal length may differ by one frame.
  const uint32_t expected = _rate * ms / (uint32_t{RateUnit} * 1000);
  const uint32_t least = expected > 1 ? expected - 1 : 0;
  const uint32_t all = came > least ? came : least;
  if (all == 0) {
    // A second has just begun, or a line without a timeout has long been silent.
    return _count < MarkCount && state == LinkState::Ok ? 100 : 0;
  }
  return static_cast<uint8_t>(good * 100 / all);
}

}  // namespace sbus
