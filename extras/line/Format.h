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

}  // namespace line
