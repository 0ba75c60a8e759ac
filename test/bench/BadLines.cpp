// The cost of bad lines, on average. LongestCall.cpp searches for the worst call.
#include "Bench.h"

#include <algorithm>
#include <cstdio>

#include "line/Line.h"
#include "line/simulation/Random.h"
#include "support/Bytes.h"
#include "support/FakeClock.h"
#include "support/KnownFrames.h"

#include "Cost.h"  // last: Arduino.h has a type named byte

namespace {

using line::Random;

constexpr uint32_t MostPerByte = 107;  // a tenth more than was measured with GCC 12.2

// A pattern that repeats forever without a gap.
struct BadLine {
  const char *name;
  Bytes pattern;

  uint8_t operator[](size_t index) const { return pattern[index % pattern.size()]; }
};

Bytes random() {
  Random random(20181);
  Bytes bytes(4096);
  std::generate(bytes.begin(), bytes.end(), [&] { return random.byte(); });
  return bytes;
}

// From the lines with the longest calls found: every header may begin a frame, and few do.
Bytes runs() {
  Random random(1);
  Bytes bytes;
  while (bytes.size() < 4096) {
    bytes = bytes + Bytes(1 + random.below(40), 0x0F);
    const uint8_t ends[] = {0x00, 0x00, 0x00, 0x04, 0x08, 0x14};
    bytes = bytes + Bytes(1 + random.below(40), ends[random.below(6)]);
  }
  return bytes;
}

const std::vector<BadLine> &badLines() {
  static const Frame frame = Neutral.bytes;
  static const std::vector<BadLine> all = {
      {"random bytes", random()},
      {"runs of 0F and of end bytes", runs()},
      {"0F without end", {0x0F}},
      {"0F 00 in turn", {0x0F, 0x00}},
      {"24 of 0F, 24 of 0C: none of 24 headers has an end byte", Bytes(24, 0x0F) + Bytes(24, 0x0C)},
      {"24 of 0F, 24 of 00: each of them has, and flags", Bytes(24, 0x0F) + Bytes(24, 0x00)},
      {"24 of 0F, 24 of 04: and a byte too many", Bytes(24, 0x0F) + Bytes(24, 0x04)},
      {"neutral frames without a gap", bytesOf(frame)},
      {"neutral frames with end byte 0C", bytesOf(withByte(frame, 24, 0x0C))},
      {"neutral frames with flags 10", bytesOf(withByte(frame, 23, 0x10))},
      {"neutral frames that lack a byte", without(frame, 12)},
      {"neutral frames with a byte too many", with(frame, 12, 0x0F)},
      {"neutral frames, a telemetry answer after each", bytesOf(withByte(frame, 24, 0x04)) + Bytes{0x03, 0xC0, 0x2E}},
  };
  return all;
}

// Returns the cost of a byte, with 16 in a call, as the board's driver hands them over.
template <typename Receiver>
double streamCost(const BadLine &line) {
  constexpr size_t Count = 4096;
  constexpr size_t Burst = 16;
  fakeMicros = 0;
  Receiver both;
  both.receiver.begin();
  uint32_t sum = 0;
  for (size_t at = 0; at < Count;) {
    uint8_t bytes[Burst];
    std::generate_n(bytes, Burst, [&] { return line[at++]; });
    fakeMicros += Burst * line::CharacterUs;
    sum += take(both, bytes, Burst).instructions;
  }
  return static_cast<double>(sum) / Count;
}

}  // namespace

void printBadLines() {
  std::printf("\n| per byte of a line without a gap, 16 in a call | ours | the baseline |\n| --- | --- | --- |\n");
  for (const BadLine &line : badLines()) {
    std::printf("| %s | %.1f | %.1f |\n", line.name, streamCost<Ours>(line), streamCost<Papers>(line));
  }
}

void checkBadLines() {
  for (const BadLine &line : badLines()) {
    atMost("a byte of " + std::string(line.name), static_cast<uint32_t>(streamCost<Ours>(line)), MostPerByte);
  }
}
