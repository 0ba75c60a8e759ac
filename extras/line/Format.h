// Short texts with numbers.
#pragma once

#include <cstdio>
#include <string>

namespace line {

// Formats like std::snprintf(), up to 399 characters.
template <typename... Values>
std::string format(const char *pattern, Values... values) {
  char text[400];
  std::snprintf(text, sizeof text, pattern, values...);
  return text;
}

// Returns a time in us as seconds, to be printed.
template <typename Us>
constexpr double seconds(Us us) {
  return static_cast<double>(us) / 1e6;
}

}  // namespace line
