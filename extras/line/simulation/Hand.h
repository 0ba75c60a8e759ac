// How a hand moves sticks and switches. Integers only, so that every machine sends the same bytes.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>

namespace line {

// A FrSky radio's values.
constexpr uint16_t Low = 172;
constexpr uint16_t Centre = 992;
constexpr uint16_t High = 1811;

// Returns a triangle wave, -1024..1024, which begins at 0.
inline int triangle(uint32_t ms, uint32_t periodMs) {
  const uint32_t phase = (ms + periodMs / 4) % periodMs;
  const int rising = static_cast<int>(phase * 4096 / periodMs) - 1024;  // -1024..3071
  return rising <= 1024 ? rising : 2048 - rising;
}

// Returns a stick moved by hand: a triangle with rounded corners, close to a sine.
inline uint16_t stick(uint32_t ms, uint32_t periodMs, int travel, uint16_t centre = Centre) {
  const int x = triangle(ms, periodMs);
  const int rounded = x * (2048 - std::abs(x)) / 1024;
  return static_cast<uint16_t>(centre + travel * rounded / 1024);
}

// Returns a value that moves from one end to the other and back, and rests at each end for 0.1 periods. It begins low.
inline uint16_t sweep(uint32_t ms, uint32_t periodMs) {
  const int x = triangle(ms + periodMs * 3 / 4, periodMs) * 5 / 4;
  return static_cast<uint16_t>(Low + (High - Low) * (std::clamp(x, -1024, 1024) + 1024) / 2048);
}

// Returns a switch that changes its position every `restMs`. It begins low.
inline uint16_t twoPositions(uint32_t ms, uint32_t restMs) { return ms / restMs % 2 == 0 ? Low : High; }
inline uint16_t threePositions(uint32_t ms, uint32_t restMs) {
  constexpr uint16_t Positions[] = {Low, Centre, High};
  return Positions[ms / restMs % 3];
}

}  // namespace line
