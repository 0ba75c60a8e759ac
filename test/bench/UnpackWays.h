// Other ways to unpack the sixteen channels of a frame, to compare with sbus::unpack() and sbus::unpackAligned().
#pragma once

#include <stdint.h>

// Takes each of the 176 bits by itself, as the format is defined.
void unpackBitByBit(const uint8_t *frame, uint16_t *channels);

// Shifts bytes into a word, and channels out of it.
void unpackShifting(const uint8_t *frame, uint16_t *channels);
