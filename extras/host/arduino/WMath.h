// Random numbers, map() and word(). As on the board, a long has 32 bits, so map() overflows with large numbers.
#pragma once

#include <stdint.h>
#include <stdlib.h>

// Each start gives the same numbers, until randomSeed() is called with a value other than 0.
inline void randomSeed(unsigned long seed) {
  if (seed != 0) {
    srand(static_cast<unsigned>(seed));
  }
}

// Returns 0..end-1, or 0 if `end` is 0.
inline long random(long end) { return end == 0 ? 0 : rand() % end; }

// Returns begin..end-1, or `begin` if the range is empty.
inline long random(long begin, long end) { return begin >= end ? begin : random(end - begin) + begin; }

inline long map(long x, long fromLow, long fromHigh, long toLow, long toHigh) {
  const uint32_t product = static_cast<uint32_t>(x - fromLow) * static_cast<uint32_t>(toHigh - toLow);
  return static_cast<int32_t>(product) / static_cast<int32_t>(fromHigh - fromLow) + toLow;
}

inline uint16_t makeWord(uint16_t number) { return number; }
inline uint16_t makeWord(uint8_t high, uint8_t low) { return static_cast<uint16_t>(high << 8 | low); }
#define word(...) makeWord(__VA_ARGS__)
