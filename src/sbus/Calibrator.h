// Finds out what one radio really sends, as ground stations do: the sticks move through their whole travel, then rest.
//
//   sbus::Calibrator calibrator;     // 1. move all sticks, sliders and switches to all their ends
//   calibrator.feed(...)             //    each frame
//   calibrator.centre();             // 2. sticks centred, throttle low, hands off
//   calibrator.feed(...)
//   calibrator.high();               // 3. all sticks up and right; may be left out if no channel runs backwards
//   calibrator.feed(...)
//   calibrator.finish(...)
#pragma once

#include <stdint.h>

#include "Calibration.h"

namespace sbus {

// Why a channel cannot be calibrated.
enum class Refusal : uint8_t {
  None,           // it can
  NeverSeen,      // not a frame came in one of the steps that were begun
  HardlyMoved,    // its travel is shorter than Calibrator::TravelMin
  CentreOutside,  // it rests outside its travel: it was not moved to all its ends
  NotStill,       // it moved while it was to rest
  NotCentred,     // it rests neither near the middle of its travel nor at an end
  NotPushed,      // it hardly moved in the third step, if that was begun: whether it runs backwards is not known
};

// In words, to stand behind a channel's name: "CH3" " hardly moved". "" for None.
const char *text(Refusal refusal);

// All calls from one context. It waits for nothing and keeps no time: who calls it decides how long a step lasts. Half
// a second of frames will do for the second step, and one frame for the third.
class Calibrator {
 public:
  static constexpr uint16_t TravelMin = 400;      // raw counts, a quarter of a FrSky's travel: less was not moved
  static constexpr uint16_t StillMax = 32;        // raw counts, 2 % of it: what a stick that rests may jitter
  static constexpr uint16_t DefaultDeadZone = 8;  // raw counts, half a percent of it: 5 us
  static constexpr uint16_t DeadZoneMax = TravelMin / 4 - 1;  // raw counts, 99: it ends before the shortest side does

  Calibrator() { begin(); }

  // Forgets all; the first step begins: all channels are to go through their whole travel. The dead zone stays.
  void begin() { begin(Travel); }

  // The second step begins: sticks centred, throttle low, nothing moves. Once more, and it begins anew.
  void centre() { begin(Centre); }

  // The third step begins: what is to count as + is pushed there, that is up or right, and may be let go again. A
  // channel that fell by more than a quarter of its travel, and more than it rose, runs backwards.
  void high() { begin(High); }

  // A frame, as decodeSBusFrame() has it. One with either flag set says nothing of the sticks, and does nothing.
  void feed(const uint16_t channels[], bool failsafe, bool lostFrame);

  // Raw counts on either side of the centre: 0..99, DefaultDeadZone unless told; more is taken for 99. A stick that
  // jitters gets more by itself. A channel that rests at an end has none.
  void setDeadZone(uint16_t counts) { _deadZone = counts > DeadZoneMax ? uint16_t{DeadZoneMax} : counts; }

  // One channel, 0..15 for CH1..CH16. Refusal::None: `calibrated` is what it sends. Else `calibrated` stays. May be
  // asked at any time, and as often as one likes. One that rests within 1/16 of an end of its travel (throttle, switch)
  // has its centre in the middle of it; the others must rest at least 1/4 away from both ends.
  Refusal result(uint8_t channel, CalibratedChannel &calibrated) const { return measure(channel, true, calibrated); }

  // All channels. Those of which a bit is set in `wanted` (bit 0: CH1) must be good: if one is not, the answer is why,
  // `channel` is the first such (0..15), and `calibration` stays as it is. Else it is Refusal::None, `calibration` is
  // sealed, and `channel` is left alone. Of those not wanted, NotCentred ones (a knob, a switch of six positions) have
  // their centre in the middle of their travel, NotPushed ones do not run backwards, and the others that are not good
  // are not calibrated.
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
