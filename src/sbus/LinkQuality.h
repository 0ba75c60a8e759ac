/// @file
/// Link quality: the percentage of the expected frames that came and were not lost.
#pragma once

#include <stdint.h>

#include "Counters.h"
#include "Link.h"

namespace sbus {

/// Measures the link quality over the last second, from what a decoder counts anyway:
///
///     sbus::LinkQuality quality;
///     uint8_t percent = quality.update(dSBus);
///
/// 100 means that every expected frame came, without the lost-frame or failsafe flag. Betaflight computes the link
/// quality of S.Bus likewise (src/main/rx/rx.c, setLinkQuality()). ExpressLRS's own number counts radio packets, not
/// frames (extras/docs/link-quality.md).
///
/// The receiver's frame rate is not known: the expected rate is the highest one seen, reduced by one frame a second
/// every ten seconds, until the measured rate is higher again.
class LinkQuality {
 public:
  /// Returns the link quality at `now`, us, 0..100; 0 before the first frame and while the link is stale. Call it every
  /// 250 ms or more often, from one context: if less often, it measures over four calls instead of a second. In the
  /// first second after the link came back it knows no rate, and returns the percentage of the received frames that
  /// were not lost. If the last call is more than 2 s ago, it returns 100 or 0, by the newest frame.
  uint8_t update(const Counters &counters, LinkState state, uint32_t now) {
    const Mark mark = {now, counters.frames, counters.lostFrames, counters.failsafeFrames};
    const Mark &oldest = _marks[_count < MarkCount ? 0 : _next];
    const Mark &newest = _marks[(_next + MarkCount - 1) % MarkCount];
    if (state == LinkState::NeverSeen || state == LinkState::Stale || _count == 0 || now - newest.time > PauseMax ||
        isBelow(mark.frames, oldest.frames)) {
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
    if ((now - newest.time) / 1000 >= MarkTime) {
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
    // A window may hold one frame more or less.
    const uint32_t expected = _rate * ms / (uint32_t{RateUnit} * 1000);
    const uint32_t least = expected > 1 ? expected - 1 : 0;
    const uint32_t all = came > least ? came : least;
    if (all == 0) {
      // A second has just begun, or a line without a timeout has long been silent.
      return _count < MarkCount && state == LinkState::Ok ? 100 : 0;
    }
    return static_cast<uint8_t>(good * 100 / all);
  }

  /// Returns the link quality of a DecodeSBus, or of another decoder, now.
  template <typename Decoder>
  uint8_t update(Decoder &decoder) {
    return update(decoder.counters(), decoder.linkState(), decoder.clock());
  }

 private:
  static constexpr uint8_t MarkCount = 4;
  static constexpr uint16_t MarkTime = 250;      // ms
  static constexpr uint32_t PauseMax = 2000000;  // us
  static constexpr uint16_t RateUnit = 256;      // units of _rate in one frame a second
  static constexpr uint8_t Decay = 6;            // units in 250 ms: 0.1 frames a second, each second

  struct Mark {
    uint32_t time;  // us
    uint32_t frames, lost, failsafe;
  };

  // Most frames with one of the flags have both: so take the larger count, not the sum.
  static uint32_t badOf(uint32_t lost, uint32_t failsafe) { return lost > failsafe ? lost : failsafe; }

  // After begin() the counters are 0 again.
  static bool isBelow(uint32_t frames, uint32_t before) { return static_cast<int32_t>(frames - before) < 0; }

  Mark _marks[MarkCount];  // 250 ms apart
  uint8_t _count = 0;      // of them
  uint8_t _next = 0;       // where the next one goes; the oldest, if there are four
  uint16_t _rate = 0;      // 1/256 frames a second
};

}  // namespace sbus
