// The units of a channel's value: raw, microseconds of a servo pulse, percent of the travel.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "sbus/Scaling.h"

namespace line {

enum class Unit { Raw, Us, Percent };

// Converts a raw value. Microseconds are 5 * raw / 8 + 880 for any make; 0 % and +-100 % are the points of `range`.
double valueOf(uint16_t raw, Unit unit, const sbus::Range &range);

// Returns the nearest raw value; nothing if it is outside 0 to 2047, or if a raw value is not a whole number.
std::optional<uint16_t> rawOf(double value, Unit unit, const sbus::Range &range);

// Returns true if these can be the raw values at -100, 0 and +100 %: 0 to 2047, rising or falling.
bool isRange(unsigned low, unsigned centre, unsigned high);

// Returns 7 for "ch7"; 0 if the text is not one of ch1 to ch32.
unsigned channelOf(std::string_view text);

// Reads "1500", "1500us" or "-50%". Returns nothing for any other text.
std::optional<uint16_t> parseValue(const std::string &text, const sbus::Range &range);

}  // namespace line
