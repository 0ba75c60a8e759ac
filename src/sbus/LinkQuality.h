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
  /// 250 ms or more often, from one context. In the first second after the link came back, and if the last call is more
  /// than a second ago, it knows no rate, and returns the percentage of the received frames that were not lost.
  uint8_t update(const Counters &counters, LinkState state, uint32_t now);

  /// Returns the link quality of a DecodeSBus, or of another decoder, now.
  template <typename Decoder>
  uint8_t update(Decoder &decoder) {
    return update(decoder.counters(), decoder.linkState(), decoder.clock());
  }

 private:
  static constexpr uint8_t MarkCount = 4;
  static constexpr uint16_t MarkTime = 250;  // ms
  static constexpr uint16_t LongestTime = 2 * MarkCount * MarkTime;

  struct Mark {
    uint32_t time;  // us
    uint32_t frames, lost, failsafe;
  };

  Mark _marks[MarkCount];  // 250 ms apart
  uint8_t _count = 0;      // of them
  uint8_t _next = 0;       // where the next one goes; the oldest, if there are four
  uint16_t _rate = 0;      // 1/256 frames a second
};

}  // namespace sbus
