/// @file
/// Finds out what one radio really sends, as ground stations do: the sticks move through their whole travel, then rest.
///
///     sbus::Calibrator calibrator;     // 1. move all sticks, sliders and switches to all their ends
///     calibrator.feed(...)             //    each frame
///     calibrator.centre();             // 2. sticks centred, throttle low, hands off
///     calibrator.feed(...)
///     calibrator.high();               // 3. all sticks up and right; may be left out if no channel runs backwards
///     calibrator.feed(...)
///     calibrator.finish(...)
#pragma once

#include <stdint.h>

#include "Calibration.h"

namespace sbus {

/// Why a channel cannot be calibrated.
enum class Refusal : uint8_t {
  None,           ///< it can
  NeverSeen,      ///< not a frame came in one of the steps that were begun
  HardlyMoved,    ///< its travel is shorter than Calibrator::TravelMin
  CentreOutside,  ///< it rests outside its travel: it was not moved to all its ends
  NotStill,       ///< it moved while it was to rest
  NotCentred,     ///< it rests neither near the middle of its travel nor at an end
  NotPushed,      ///< it hardly moved in the third step, if that was begun: whether it runs backwards is not known
};

/// In words, to stand after a channel's name: "CH3" " hardly moved". "" for None.
const char *text(Refusal refusal);

/// All calls come from one context. It keeps no time: the caller decides how long a step lasts. Half a second of frames
/// will do for the second step, one frame for the third.
class Calibrator {
 public:
  static constexpr uint16_t TravelMin = 400;      ///< raw counts, a quarter of a FrSky's travel: less was not moved
  static constexpr uint16_t StillMax = 32;        ///< raw counts, 2 % of it: what a stick that rests may jitter
  static constexpr uint16_t DefaultDeadZone = 8;  ///< raw counts, half a percent of it: 5 us
  static constexpr uint16_t DeadZoneMax = TravelMin / 4 - 1;  ///< raw counts, 99: it ends before the shortest side does

  Calibrator() { begin(); }

  /// Forgets all but the dead zone. The first step begins: all channels go through their whole travel.
  void begin() { begin(Travel); }

  /// The second step begins, or begins anew: sticks centred, throttle low, nothing moves.
  void centre() { begin(Centre); }

  /// The third step begins: push all sticks to +, that is up and right; they may be let go again. A channel that fell
  /// by more than a quarter of its travel, and more than it rose, runs backwards.
  void high() { begin(High); }

  /// Call it with every frame that decodeSBusFrame() hands out. One with either flag set is ignored.
  void feed(const uint16_t channels[], bool failsafe, bool lostFrame);

  /// Raw counts on either side of the centre: 0..99, clamped; DefaultDeadZone unless told. A stick that jitters gets
  /// more by itself. A channel that rests at an end has none.
  void setDeadZone(uint16_t counts) { _deadZone = counts > DeadZoneMax ? uint16_t{DeadZoneMax} : counts; }

  /// One channel, 0..15 for CH1..CH16, at any time. Refusal::None: `calibrated` is what it sends; else it is left
  /// alone.
  ///
  /// A channel that rests within 1/16 of an end of its travel (throttle, switch) has its centre in the middle of it.
  /// The others must rest at least 1/4 away from both ends.
  Refusal result(uint8_t channel, CalibratedChannel &calibrated) const { return measure(channel, true, calibrated); }

  /// All channels. Refusal::None: `calibration` is sealed, `channel` is left alone. Else why the first wanted channel
  /// that is not good was refused, `channel` (0..15) is which, and `calibration` is left alone.
  ///
  /// `wanted` has a bit set for each channel that must be good (bit 0: CH1). Of the others, NotCentred ones (a knob, a
  /// switch of six positions) have their centre in the middle of their travel, NotPushed ones do not run backwards, and
  /// the rest are not calibrated.
  Refusal finish(uint16_t wanted, Calibration &calibration, uint8_t &channel) const;

 private:
  enum Step : uint8_t { Travel, Centre, High, StepCount };

  struct Extent {  // of what was seen; nothing if low is above high
    uint16_t low;
    uint16_t high;
    void include(uint16_t value);
    bool seen() const { return low <= high; }
  };

  void begin(Step step);
  Refusal measure(uint8_t channel, bool wanted, CalibratedChannel &calibrated) const;

  Extent _seen[StepCount][ProportionalCount];
  uint16_t _deadZone = DefaultDeadZone;
  Step _step;
};

}  // namespace sbus
