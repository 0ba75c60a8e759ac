/// @file
/// Measures what one radio really sends, as ground stations do: move the sticks through their whole travel, then let
/// them rest.
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
#include "Text.h"

namespace sbus {

/// Why a channel cannot be calibrated yet.
enum class CalibrationError : uint8_t {
  None,           ///< it can be calibrated
  NeverSeen,      ///< no frames came in the first step
  HardlyMoved,    ///< its travel is shorter than Calibrator::TravelMin
  CentreOutside,  ///< it rests or is held outside its travel: it was not moved to both ends
  NotStill,       ///< it moved in the second step
  NotCentred,     ///< it rests neither near the middle of its travel nor at an end
  NotPushed,      ///< it ended where it rested, or there was no third step: its direction is unknown
  MovedOneWay,    ///< an end of its travel is where sticks have their centre, 700..1350 raw
  NotRested,      ///< the second step has not begun, or no frame came in it
  NotHeld,        ///< it was not held still for Calibrator::HeldFrames at the end of the third step
};

/// Returns what is wrong and what to do, as a text to print after a channel's name: "CH3" " hardly moved: move it to
/// both ends". Returns "" for None.
Text text(CalibrationError error);

/// Measures the travel of all channels in three steps. Call all methods from one context. The caller decides how long a
/// step lasts: the second needs half a second of frames, the third one second, or two if the frame period exceeds 14
/// ms.
class Calibrator {
 public:
  static constexpr uint16_t TravelMin = 400;      ///< raw counts, a quarter of a FrSky's travel: less is not movement
  static constexpr uint16_t StillMax = 32;        ///< raw counts, 2 % of that travel: the jitter of a resting stick
  static constexpr uint8_t SeenFrames = 3;        ///< frames in a row that must reach an end for it to count
  static constexpr uint8_t HeldFrames = 64;       ///< frames at one place that count as held: 0.45..0.9 s
  static constexpr uint16_t DefaultDeadZone = 8;  ///< raw counts, half a percent of that travel: 5 us
  static constexpr uint16_t DeadZoneMax = TravelMin / 4 - 1;  ///< raw counts, 99: shorter than the shortest side

  Calibrator() { begin(); }

  /// Starts the first step, in which all channels move through their whole travel. Forgets all but the dead zone.
  void begin() { begin(Travel); }

  /// Starts the second step, or starts it again: sticks centred, throttle low, nothing moves.
  void centre() { begin(Centre); }

  /// Starts the third step: push all sticks up and right, and hold them there until it ends. Only the place where they
  /// are held counts. A channel that is held more than a quarter of its travel below its resting place is reversed.
  void high() { begin(High); }

  /// Takes a frame of decodeSBusFrame(): call it once for each frame. Ignores frames with a flag set. A wrong value in
  /// one or two frames does no harm in the first and third step; in the second it gives NotStill.
  void feed(ChannelArray<const uint16_t, ProportionalCount> channels, bool failsafe, bool lostFrame);

  /// Sets the dead zone on either side of the centre, 0..99 raw counts, clamped. Default: DefaultDeadZone. A stick that
  /// jitters more gets a larger dead zone. A channel that rests at an end has no dead zone.
  void setDeadZone(uint16_t counts) { _deadZone = counts > DeadZoneMax ? uint16_t{DeadZoneMax} : counts; }

  /// Reports how far a channel, 0..15, has moved in the first step. Returns false, and leaves both unchanged, while no
  /// end has been seen.
  bool reached(uint8_t channel, uint16_t &low, uint16_t &high) const;

  /// Calibrates one channel, 0..15 for CH1..CH16, and returns None. If that is not possible yet, leaves `calibrated`
  /// unchanged, and returns what is missing first: NotRested once it has moved, NotPushed once it has rested. Call it
  /// at any time.
  ///
  /// A channel that rests within 1/16 of an end of its travel (throttle, switch) has its centre in the middle of the
  /// travel, unless it rests at 700..1350: then it was moved one way only. Other channels must rest at least 1/4 away
  /// from both ends. A channel may rest and be held 1/16 beyond the travel of the first step.
  CalibrationError result(uint8_t channel, CalibratedChannel &calibrated) const {
    return measure(channel, true, calibrated);
  }

  /// Calibrates all channels, and seals `calibration`. If a required channel fails it leaves `calibration` unchanged,
  /// sets `channel` (0..15) to the first such channel, and returns its error. If no channel is required and all fail,
  /// that is CH1.
  ///
  /// `required` has a bit set for each channel that must not fail (bit 0: CH1). Of the other channels, NotCentred ones
  /// (a knob, a switch of six positions) get their centre in the middle of their travel, NotPushed ones are not
  /// reversed, and the rest stay uncalibrated. Without the third step every channel fails.
  CalibrationError finish(uint16_t required, Calibration &calibration, uint8_t &channel) const;

 private:
  enum Step : uint8_t { Travel, Centre, High };

  struct Extent {  // low is above high until several frames agree
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
    uint16_t place;   // follows values near it by one count a frame
    uint16_t frames;  // near it, less those that are not
    void follow(uint16_t value);
  };
  union Lately {
    Window window;
    Hold hold;
  };

  void begin(Step step);
  CalibrationError measure(uint8_t channel, bool required, CalibratedChannel &calibrated) const;

  Extent _seen[High][ProportionalCount];
  Lately _lately[ProportionalCount];
  uint16_t _deadZone = DefaultDeadZone;
  Step _step;
  uint8_t _frames;  // of this step, SeenFrames at most
};

}  // namespace sbus
