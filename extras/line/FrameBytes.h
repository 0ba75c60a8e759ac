// Makes the bytes of a frame: of each kind that an Observer finds, and the characters that they are on a line.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "line/Segments.h"
#include "line/Statistics.h"

namespace line {

// Returns the bytes of a frame of this kind: of one with header 2F those of CH17 to CH32. Both switches and flags are
// the frame's own.
std::vector<uint8_t> frameBytes(Stretch::Kind kind, const Values &values, uint8_t end = 0);

// Returns the values with the switches and flags of another flags byte: those of a frame with header 2F, of which an
// Observer tells only the channels.
Values withFlags(Values values, uint8_t flagsByte);

// Appends characters without times, back to back, so that the last one ends at `endUs`; later if the line is busy until
// `lastUs`. Returns when it ends.
uint64_t appendBackToBack(const std::vector<Character> &came, uint64_t endUs, uint64_t lastUs, uint32_t characterUs,
                          std::deque<Character> &characters);

// Returns the bytes as characters without times.
std::vector<Character> charactersOf(const std::vector<uint8_t> &bytes);

}  // namespace line
