// A short text with numbers in it.
#pragma once

#include <cstdio>
#include <string>

namespace line {

// Formats like std::snprintf(), and cuts the text after 399 characters.
template <typename... Values>
std::string format(const char *pattern, Values... values) {
  char text[400];
  std::snprintf(text, sizeof text, pattern, values...);
  return text;
}

}  // namespace line
