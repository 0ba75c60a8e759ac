// Lines that cost a receiver more than a clean one. Each is a pattern that repeats without end and without a pause.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

struct Line {
  const char *name;
  std::vector<uint8_t> pattern;

  uint8_t operator[](size_t index) const { return pattern[index % pattern.size()]; }
};

const std::vector<Line> &lines();
