// The moves of a person at the radio, and the reception meanwhile.
#pragma once

#include <cstdint>

namespace line {

enum class Sticks { Flight, Calibration };

enum class Radio { Received, Lost, Failsafe };

// Repeats every `periodMs`. `ms` is a frame's time within the period, `frameNumber` counts from the first frame.
struct Choreography {
  uint32_t periodMs;
  Radio (*radio)(uint32_t frameNumber, uint32_t ms);
  void (*move)(uint32_t frameNumber, uint32_t ms, uint16_t *channels);  // 18 channels, as for sbus::pack()
};

// 15 s: the sticks move, a few frames are lost; at 9.5 s the radio is switched off: the receiver first loses frames,
// then goes into failsafe; at 12.5 s the radio is back.
extern const Choreography Flight;

// 40 s: all sticks and switches move through their whole travel (0..14 s), sticks released and throttle low (15..22 s),
// both sticks up and right (23..28 s; CH2 is reversed), a gentle flight (29..40 s). A few frames are lost.
extern const Choreography CalibrationMoves;

inline const Choreography &choreography(Sticks sticks) { return sticks == Sticks::Flight ? Flight : CalibrationMoves; }

// Two frames in a row, every 100 frames (0.9 s).
inline bool isLostInFlight(uint32_t frameNumber) { return frameNumber % 100 >= 60 && frameNumber % 100 < 62; }

}  // namespace line
