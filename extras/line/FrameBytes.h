// Makes the bytes of a frame of any kind that an Observer finds, and their characters on a line.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "line/Segments.h"
#include "line/Statistics.h"

namespace line {

// Returns the bytes of a frame of this kind; one with header 2F holds CH17 to CH32. Switches and flags are taken from
// `values`.
std::vector<uint8_t> frameBytes(Stretch::Kind kind, const Values &values, uint8_t end = 0);

// Appends characters without times, back to back, so that the last one ends at `endUs`, or later if the line is busy
// until `lastUs`. Returns its end.
uint64_t appendBackToBack(const std::vector<Character> &came, uint64_t endUs, uint64_t lastUs, uint32_t characterUs,
                          std::deque<Character> &characters);

// Does the same for characters that a port may have held back for `lateUs`: if there is no room for them after
// `lastUs`, they follow each other faster, so that the last one still ends at `endUs`.
uint64_t appendLate(const std::vector<Character> &came, uint64_t endUs, uint64_t lastUs, uint32_t characterUs,
                    uint32_t lateUs, std::deque<Character> &characters);

// Returns the bytes as characters without times.
std::vector<Character> charactersOf(const std::vector<uint8_t> &bytes);

}  // namespace line
