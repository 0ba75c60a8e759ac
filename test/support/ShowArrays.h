// Lets a failing test print the numbers of a Frame or Channels.
#pragma once

#include <doctest/doctest.h>

#include <array>
#include <cstddef>
#include <sstream>
#include <vector>

namespace doctest {

template <typename T, size_t Size>
struct StringMaker<std::array<T, Size>> {
  static String convert(const std::array<T, Size> &values) {
    std::ostringstream out;
    for (const T value : values) {
      out << unsigned{value} << ' ';
    }
    return out.str().c_str();
  }
};

template <typename T, size_t Size>
struct StringMaker<std::vector<std::array<T, Size>>> {
  static String convert(const std::vector<std::array<T, Size>> &arrays) {
    String text;
    for (const auto &array : arrays) {
      text += "\n    " + toString(array);
    }
    return text;
  }
};

}  // namespace doctest
