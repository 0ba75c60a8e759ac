// A second implementation of the rules of the stored calibration, one by one: the tests compare the library with it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "sbus/Calibration.h"

// Returns true if a channel is not calibrated, or its numbers are in order and the dead zone ends before low and high.
inline bool possibleByRule(const sbus::CalibratedChannel &channel) {
  const int low = channel.range.low;
  const int centre = channel.range.centre;
  const int high = channel.range.high;
  const int dead = channel.deadZone;
  const bool empty = low == 0 && centre == 0 && high == 0 && dead == 0;
  const bool forwards = low < centre - dead && centre + dead < high && high <= 2047;
  const bool backwards = high < centre - dead && centre + dead < low && low <= 2047;
  return empty || forwards || backwards;
}

// Returns the CRC-16/CCITT-FALSE, bit by bit, through a register of 16 bits.
inline uint16_t crcOf(const uint8_t *bytes, size_t count) {
  unsigned crc = 0xFFFF;
  for (size_t bit = 0; bit < 8 * count; bit++) {
    const unsigned next = bytes[bit / 8] >> (7 - bit % 8) & 1u;
    crc = (crc << 1 & 0xFFFF) ^ ((crc >> 15 ^ next) * 0x1021);
  }
  return static_cast<uint16_t>(crc);
}

// Returns true if scaling gives exactly -1000, 0, +1000 and 988, 1500, 2012 us at the three points.
inline bool isExact(const sbus::CalibratedChannel &channel) {
  const sbus::Range &range = channel.range;
  return channel.toNormalized(range.low) == -1000 && channel.toMicroseconds(range.low) == 988 &&
         channel.toNormalized(range.centre) == 0 && channel.toMicroseconds(range.centre) == 1500 &&
         channel.toNormalized(range.high) == 1000 && channel.toMicroseconds(range.high) == 2012;
}

// Two straight lines from either end of the dead zone, in floating point, clamped as the library does: `centre` at the
// range's centre, `step` less at its low, and `step` more at its high.
inline double onTheLines(int raw, const sbus::CalibratedChannel &channel, double centre, double step) {
  const sbus::Range &range = channel.range;
  const int beyond = std::abs(raw - range.centre) - channel.deadZone;
  if (beyond <= 0) {
    return centre;
  }
  const bool towardsHigh = (raw > range.centre) == (range.high > range.centre);
  const int length = std::abs((towardsHigh ? range.high : range.low) - range.centre) - channel.deadZone;
  return std::clamp(centre + (towardsHigh ? step : -step) * beyond / length, -32767.0, 32767.0);
}
