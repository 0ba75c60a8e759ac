/// @file
/// Finds out what one radio really sends, as ground stations do: the sticks move through their whole travel, then rest.
///
///     sbus::Calibrator calibrator;     // 1. move all sticks, sliders and switches to all their ends
///     calibrator.feed(...)             //    each frame
///     calibrator.centre();             // 2. sticks centred, throttle low, hands off
///     calibrator.feed(...)
///     calibrator.high();               // 3. all sticks up and right, held there until the step ends
///     calibrator.feed(...)
///     calibrator.finish(...)
#pragma once

#include <stdint.h>

#include "Calibration.h"

namespace sbus {

/// Why a channel cannot be calibrated, or what is still to be done with it.
enum class CalibrationError : uint8_t {
  None,           ///< it can
  NeverSeen,      ///< no frames came in the first step
  HardlyMoved,    ///< its travel is shorter than Calibrator::TravelMin
  CentreOutside,  ///< it rests or is held outside its travel: it was not moved to all its ends
  NotStill,       ///< it moved while it was to rest
  NotCentred,     ///< it rests neither near the middle of its travel nor at an end
  NotPushed,      ///< it ended where it rested, or there was no third step: whether it runs backwards is not known
  MovedOneWay,    ///< an end of its travel is where sticks have their centre, 700..1350 raw
  NotRested,      ///< the second step has not begun, or no frame came in it
  NotHeld,        ///< it was not held still at the end of the third step, or not for Calibrator::HeldFrames
};

/// In words, to stand after a channel's name: what is wrong, and what to do. "CH3" " hardly moved: move it to both
/// ends". "" for None.
const char *text(CalibrationError refusal);

/// All calls come from one context. It keeps no time: the caller decides how long a step lasts. Half a second of frames
/// will do for the second step; the third needs a second, or two with receivers that send less often than 14 ms.
class Calibrator {
 public:
  static constexpr uint16_t TravelMin = 400;      ///< raw counts, a quarter of a FrSky's travel: less was not moved
  static constexpr uint16_t StillMax = 32;        ///< raw counts, 2 % of it: what a stick that rests may jitter
  static constexpr uint8_t SeenFrames = 3;        ///< an end counts when so many frames in a row have seen it
  static constexpr uint8_t HeldFrames = 64;       ///< so many frames at one place are held: 0.45..0.9 s
  static constexpr uint16_t DefaultDeadZone = 8;  ///< raw counts, half a percent of it: 5 us
  static constexpr uint16_t DeadZoneMax = TravelMin / 4 - 1;  ///< raw counts, 99: it ends before the shortest side does

  Calibrator() { begin(); }

  /// Forgets all but the dead zone. The first step begins: all channels go through their whole travel.
  void begin() { begin(Travel); }

  /// The second step begins, or begins anew: sticks centred, throttle low, nothing moves.
  void centre() { begin(Centre); }

  /// The third step begins: push all sticks to +, that is up and right, and hold them there until it ends. What they
  /// pass on their way does not count. A channel that is held more than a quarter of its travel below where it rested
  /// runs backwards.
  void high() { begin(High); }

  /// Call it with every frame that decodeSBusFrame() hands out, once. One with either flag set is ignored. A wrong
  /// value in one or two frames does no harm; in the second step it is NotStill.
  void feed(const uint16_t channels[], bool failsafe, bool lostFrame);

  /// Raw counts on either side of the centre: 0..99, clamped; DefaultDeadZone unless told. A stick that jitters gets
  /// more by itself. A channel that rests at an end has none.
  void setDeadZone(uint16_t counts) { _deadZone = counts > DeadZoneMax ? uint16_t{DeadZoneMax} : counts; }

  /// How far a channel, 0..15, has come in the first step. False: no end has been seen yet, and both are left alone.
  bool reached(uint8_t channel, uint16_t &low, uint16_t &high) const;

  /// One channel, 0..15 for CH1..CH16, at any time. CalibrationError::None: `calibrated` is what it sends; else it is left
  /// alone, and the answer is the first thing that is still to be done: NotRested once it has moved, NotPushed once it
  /// has rested.
  ///
  /// A channel that rests within 1/16 of an end of its travel (throttle, switch) has its centre in the middle of it,
  /// unless it rests at 700..1350: then it was moved one way only. The others must rest at least 1/4 away from both
  /// ends. Where it rests and is held may be 1/16 further than it came in the first step.
  CalibrationError result(uint8_t channel, CalibratedChannel &calibrated) const { return measure(channel, true, calibrated); }

  /// All channels. CalibrationError::None: `calibration` is sealed, `channel` is left alone. Else why the first wanted channel
  /// that is not good was refused, `channel` (0..15) is which, and `calibration` is left alone. If none is wanted and
  /// none is good, that is CH1.
  ///
  /// `wanted` has a bit set for each channel that must be good (bit 0: CH1). Of the others, NotCentred ones (a knob, a
  /// switch of six positions) have their centre in the middle of their travel, NotPushed ones do not run backwards, and
  /// the rest are not calibrated. Without the third step no channel is good.
  CalibrationError finish(uint16_t wanted, Calibration &calibration, uint8_t &channel) const;

 private:
  enum Step : uint8_t { Travel, Centre, High };

  struct Extent {  // of what was seen; low may be above high until several frames agree
    uint16_t low;
    uint16_t high;
    void include(uint16_t value) { include(value, value); }
    void include(uint16_t lowest, uint16_t highest);
    bool seen() const { return low != UINT16_MAX; }
  };

  struct Window {  // first step: the two frames before
    uint16_t last;
    uint16_t before;
  };
  struct Hold {       // third step
    uint16_t place;   // one count a frame towards what is near it
    uint16_t frames;  // that say so, less those that do not
    void follow(uint16_t value);
  };
  union Lately {
    Window window;
    Hold hold;
  };

  void begin(Step step);
  CalibrationError measure(uint8_t channel, bool wanted, CalibratedChannel &calibrated) const;

  Extent _seen[High][ProportionalCount];
  Lately _lately[ProportionalCount];
  uint16_t _deadZone = DefaultDeadZone;
  Step _step;
  uint8_t _frames;  // of this step, SeenFrames at most
};

}  // namespace sbus
