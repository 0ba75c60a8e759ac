/// @file
/// Converts raw values to microseconds and to parts of the travel, with integers only; toUnit() returns a float.
#pragma once

#include <stdint.h>

namespace sbus {

/// The raw values, 0..2047, of a channel at -100 %, 0 % and +100 %. A reversed channel has its low above its high.
struct Range {
  uint16_t low;     ///< at -100 %
  uint16_t centre;  ///< at 0 %
  uint16_t high;    ///< at +100 %
};

// The ranges of two makes without trims; the radio's settings can change them.
constexpr Range FrSky = {172, 992, 1811};    ///< R-XSR and similar
constexpr Range Futaba = {352, 1024, 1696};  ///< R7008SB and similar

// Servo pulses at these points: Betaflight's 5 * raw / 8 + 880 for a FrSky, within 1 us.
constexpr int16_t LowPulse = 988;      ///< us, at -100 %
constexpr int16_t CentrePulse = 1500;  ///< us, at 0 %
constexpr int16_t HighPulse = 2012;    ///< us, at +100 %

/// Returns a servo pulse in us: 988, 1500 and 2012 at the three points of `range`, with straight lines between and
/// beyond them, rounded to the nearest. Values beyond the range are not clamped: see limited(). A side without length
/// gives 1500.
int16_t toMicroseconds(uint16_t raw, const Range &range);

/// Returns the raw value, 0..2047, for a pulse of `us`. From raw to us and back the error is at most 1 if no side of
/// the range is longer than 1024.
uint16_t fromMicroseconds(int16_t us, const Range &range);

/// Returns thousandths of the travel: -1000, 0 and +1000 at the three points of `range`, with straight lines between
/// and beyond them, like toMicroseconds().
int16_t toNormalized(uint16_t raw, const Range &range);

/// Returns the raw value, 0..2047, for thousandths of the travel: the exact inverse of toNormalized() if no side of the
/// range is longer than 1000.
uint16_t fromNormalized(int16_t thousandths, const Range &range);

/// Returns `value` clamped to low..high: limited(toNormalized(raw, FrSky), -1000, 1000).
constexpr int16_t limited(int32_t value, int16_t low, int16_t high) {
  return static_cast<int16_t>(value < low ? low : value > high ? high : value);
}

/// Returns the paper's scale (S. Levy): -1 at the range's low, +1 at its high, as one straight line that ignores the
/// centre; 0 if the range has no length. A sketch that does not call it does not pay for floating point.
inline float toUnit(uint16_t raw, const Range &range) {
  return range.high == range.low
             ? 0
             : static_cast<float>(raw - range.low) / static_cast<float>(range.high - range.low) * 2 - 1;
}

}  // namespace sbus
