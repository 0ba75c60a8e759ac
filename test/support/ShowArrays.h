// Lets a failing test print the numbers of a Frame or Channels.
#pragma once

#include <doctest/doctest.h>

#include <array>
#include <cstddef>
#include <vector>

namespace doctest {

template <typename T, size_t Size>
struct StringMaker<std::array<T, Size>> {
  static String convert(const std::array<T, Size> &values) {
    String text;
    for (const T value : values) {
      text += toString(unsigned{value}) + " ";
    }
    return text;
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
