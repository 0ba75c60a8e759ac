/// @file
/// What a channel's raw value means: microseconds, or a part of the stick's travel. Integers only, but for toUnit().
#pragma once

#include <stdint.h>

namespace sbus {

/// Raw values, 0..2047, of a channel at -100 %, 0 % and +100 %. A channel that runs backwards has its low above its
/// high; the centre lies between them.
struct Range {
  uint16_t low;     ///< at -100 %
  uint16_t centre;  ///< at 0 %
  uint16_t high;    ///< at +100 %
};

// What these makes send unless trims and settings of the radio move it.
constexpr Range FrSky = {172, 992, 1811};    ///< R-XSR and the like
constexpr Range Futaba = {352, 1024, 1696};  ///< R7008SB and the like

// A servo's pulses at the three points. On a FrSky they are Betaflight's 5 * raw / 8 + 880, within 1 us.
constexpr int16_t LowPulse = 988;      ///< us, at -100 %
constexpr int16_t CentrePulse = 1500;  ///< us, at 0 %
constexpr int16_t HighPulse = 2012;    ///< us, at +100 %

/// A servo's pulse for `raw`, in us, clamped to +-32767: 988, 1500 and 2012 at the three points of `range`, straight
/// lines between and beyond them (see limited()), rounded to the nearest. A side without length gives the centre.
int16_t toMicroseconds(uint16_t raw, const Range &range);

/// The raw value, 0..2047, for a pulse of `us`. From raw to us and back it is within 1, if no side of the range is
/// longer than 1024.
uint16_t fromMicroseconds(int16_t us, const Range &range);

/// The travel in thousandths: -1000, 0 and +1000 at the three points of `range`; else as toMicroseconds().
int16_t toNormalised(uint16_t raw, const Range &range);

/// The raw value, 0..2047, at so many thousandths: the exact inverse of toNormalised() if no side of the range is
/// longer than 1000.
uint16_t fromNormalised(int16_t thousandths, const Range &range);

/// `value`, clamped: not below `low`, not above `high`. limited(toNormalised(raw, FrSky), -1000, 1000)
constexpr int16_t limited(int16_t value, int16_t low, int16_t high) {
  return value < low ? low : value > high ? high : value;
}

/// The paper's formula (S. Levy): -1 at the range's low, +1 at its high, one straight line without regard to the
/// centre; 0 if the range has no length. A float: it costs flash only where it is called.
inline float toUnit(uint16_t raw, const Range &range) {
  return range.high == range.low
             ? 0
             : static_cast<float>(raw - range.low) / static_cast<float>(range.high - range.low) * 2 - 1;
}

}  // namespace sbus
