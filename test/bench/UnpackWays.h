// Other ways to unpack the sixteen channels of a frame: the yardsticks beside sbus::unpack() and sbus::unpackAligned().
#pragma once

#include <stdint.h>

// Each of the 176 bits by itself, as the format is defined.
void unpackBitByBit(const uint8_t *frame, uint16_t *channels);

// Bytes are shifted into a word, channels out of it.
void unpackShifting(const uint8_t *frame, uint16_t *channels);
