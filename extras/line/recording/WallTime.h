// Dates, for time 0 of a line.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace line {

// The beginning of a recording's comment with this time. 1 is the version of the format.
constexpr std::string_view BeganText = "format 1, began ";

// Returns "2026-11-24T15:16:18.123456Z" for microseconds since 1970, UTC.
std::string wallTime(int64_t us);

// Parses wallTime()'s text. Returns false for any other text.
bool parseWallTime(std::string_view text, int64_t &us);

}  // namespace line
