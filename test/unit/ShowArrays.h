// Lets a failing test print the numbers of a Frame or Channels.
#pragma once

#include <doctest/doctest.h>

#include <array>
#include <cstddef>
#include <sstream>

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

}  // namespace doctest
