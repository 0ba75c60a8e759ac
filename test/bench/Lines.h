// Lines that cost a receiver more than a clean one. Each is a pattern that repeats without end and without a pause.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

struct BadLine {
  const char *name;
  std::vector<uint8_t> pattern;

  uint8_t operator[](size_t index) const { return pattern[index % pattern.size()]; }
};

const std::vector<BadLine> &badLines();

// The worst single calls that `bench.sh search` has found, as it prints them: after three frames come the bytes before
// the bar, so many in a call and so far apart, then in one call those after it.
struct WorstCall {
  uint8_t burst;
  uint16_t gapUs;
  const char *bytes;
};
extern const WorstCall WorstCalls[4];
