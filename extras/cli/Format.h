// A short text with numbers in it.
#pragma once

#include <cstdio>
#include <string>

namespace tool {

// As std::snprintf(); what is longer than 399 characters is cut off.
template <typename... Values>
std::string format(const char *pattern, Values... values) {
  char text[400];
  std::snprintf(text, sizeof text, pattern, values...);
  return text;
}

}  // namespace tool
