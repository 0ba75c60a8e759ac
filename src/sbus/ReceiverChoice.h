/// @file
/// Chooses which of two or more receivers flies. extras/docs/two-receivers.md has the rules, their reasons and sources.
#pragma once

#include <stdint.h>

#include "Frame.h"
#include "Link.h"
#include "Scaling.h"

namespace sbus {

/// What ReceiverChoice and Trainer know of a receiver.
struct Reception {
  LinkState state;    ///< NeverSeen also if its frames must not be used: see haveOtherRanges()
  unsigned long age;  ///< ms, of the newest frame; DecodeSBus::frameAge()
  uint8_t quality;    ///< 0..100: LinkQuality::update()

  static constexpr uint8_t UsableAgeMax = 100;  ///< ms: a stick moves in this time

  /// Returns true if its newest frame may be used: Ok or Lossy, and younger than UsableAgeMax, even after
  /// setTimeout(0).
  constexpr bool isUsable() const {
    return (state == LinkState::Ok || state == LinkState::Lossy) && age < UsableAgeMax;
  }
};

/// Returns true if one of two receivers sends FrSky's range and the other Futaba's: four or more of CH1..CH16 rest at
/// the one centre, as unused channels do, and none at the other. Returns false if one has too few such channels to
/// tell, or no frame yet. `one` and `other` have 16 values or more.
inline bool haveOtherRanges(const uint16_t *one, const uint16_t *other) {
  constexpr uint16_t Centres[] = {FrSky.centre, Futaba.centre};
  constexpr uint8_t Enough = 4;
  uint8_t resting[2][2] = {};  // of each frame, at each centre
  for (uint8_t i = 0; i < ProportionalCount; i++) {
    for (uint8_t c = 0; c < 2; c++) {
      const uint16_t from = static_cast<uint16_t>(Centres[c] - 1);
      resting[0][c] = static_cast<uint8_t>(resting[0][c] + (static_cast<uint16_t>(one[i] - from) <= 2));
      resting[1][c] = static_cast<uint8_t>(resting[1][c] + (static_cast<uint16_t>(other[i] - from) <= 2));
    }
  }
  for (uint8_t c = 0; c < 2; c++) {
    if (resting[0][c] >= Enough && resting[0][1 - c] == 0 && resting[1][1 - c] >= Enough && resting[1][c] == 0) {
      return true;
    }
  }
  return false;
}

/// Chooses one of `Count` receivers, 2..8. The first one is preferred:
///
/// - One that is in failsafe, stale or never seen is left at once for one that is usable, the best of these.
/// - One that loses frames is left once another's quality has been better by Margin for BetterTime.
/// - An earlier receiver flies again once its quality has been as good as the flying one's for BackTime.
/// - After a change BackTime passes before the next, unless the flying receiver is no longer usable.
/// - At the start the first to be seen flies at once, and an earlier one takes over from it without waiting, once.
/// - While none is usable, its flags say so: one in failsafe is chosen rather than a stale one, and both rather than
///   one that was never seen.
template <uint8_t Count>
class ReceiverChoice {
  static_assert(Count >= 2 && Count <= 8, "ReceiverChoice<2> to ReceiverChoice<8>");

 public:
  static constexpr uint8_t Margin = 10;        ///< percentage points of quality
  static constexpr uint16_t BetterTime = 100;  ///< ms
  static constexpr uint16_t BackTime = 1000;   ///< ms

  /// Returns the receiver that flies, 0..Count - 1, if this is known of them at `now`, ms, which may wrap. Call it in
  /// every loop(), after all have been read: a change is late by the time between two calls.
  uint8_t choose(const Reception (&receivers)[Count], uint32_t now) {
    const Reception &flying = receivers[_flying];
    const bool mustLeave = !flying.isUsable();
    _hasFlown = _hasFlown || !mustLeave;
    const bool mayLeave = now - _changed >= BackTime;
    const bool isStart = _changes == 0 && !mayLeave;
    uint8_t best = _flying;
    uint8_t good = 0;
    for (uint8_t i = 0; i < Count; i++) {
      const bool isEarlier = i < _flying;
      const uint8_t least = static_cast<uint8_t>(flying.quality + (isEarlier ? 0 : Margin));
      const uint16_t wait = isEarlier ? uint16_t{BackTime} : uint16_t{BetterTime};
      const uint8_t bit = static_cast<uint8_t>(1 << i);
      if (receivers[i].isUsable() && receivers[i].quality >= least) {
        good = static_cast<uint8_t>(good | bit);
        if ((_good & bit) == 0) {
          _since[i] = now;
        }
        const bool hasWaited = mayLeave && now - _since[i] >= wait;
        if (!mustLeave && (hasWaited || (isStart && isEarlier)) &&
            (best == _flying || receivers[i].quality > receivers[best].quality)) {
          best = i;
        }
      }
      if (mustLeave && isBetter(receivers[i], receivers[best])) {
        best = i;
      }
    }
    _good = good;
    if (best != _flying) {
      _changes += _hasFlown && (mustLeave || !isStart);
      _hasFlown = false;
      _flying = best;
      _changed = now;
    }
    return _flying;
  }

  /// Returns what choose() returned last; 0 before that.
  uint8_t flying() const { return _flying; }

  /// Returns how often another receiver has taken over from one that was usable, except at the start; 0 before that.
  uint32_t changes() const { return _changes; }

 private:
  static constexpr uint8_t Usable = 3;

  // Returns what its flags can still say: of one that is not usable the most in failsafe.
  static uint8_t rank(const Reception &receiver) {
    return receiver.isUsable()                                                               ? Usable
           : receiver.state == LinkState::NeverSeen                                          ? 0
           : receiver.state == LinkState::Failsafe && receiver.age < Reception::UsableAgeMax ? 2
                                                                                             : 1;
  }

  // Of two that are not usable, neither is better by its quality.
  static bool isBetter(const Reception &one, const Reception &other) {
    const uint8_t ranks[] = {rank(one), rank(other)};
    return ranks[0] > ranks[1] || (ranks[0] == Usable && ranks[1] == Usable && one.quality > other.quality);
  }

  uint8_t _flying = 0;
  uint8_t _good = 0;       // bits: these are as good as a receiver must be to take over
  bool _hasFlown = false;  // the one that flies has been usable since it took over
  uint32_t _changes = 0;
  uint32_t _changed = 0;        // ms, when another took over
  uint32_t _since[Count] = {};  // ms; each that is good has been since then
};

}  // namespace sbus
