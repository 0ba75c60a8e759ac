// The simulated receiver's line for a calibration sketch: which sticks move, and when.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstdlib>

#include "line/simulation/SimulatedReceiver.h"
#include "support/BitByBit.h"

namespace {

constexpr unsigned PeriodMs = 40000;

struct Range {
  unsigned low = 2047;
  unsigned high = 0;
  int fastest = 0;  // step from one frame to the next
};

// Returns the range of each channel between two times, in two rounds. Lost frames repeat old channels.
std::array<Range, 18> ranges(unsigned fromMs, unsigned untilMs) {
  line::SimulatedReceiver line(line::CalibrationMoves);
  std::array<Range, 18> ranges;
  Channels last{};
  for (unsigned ms = 0; ms < 2 * PeriodMs; ms += 9) {
    Frame frame{};
    for (uint8_t &byte : frame) {
      line::Character character;
      line.next(UINT64_MAX, character);
      byte = character.value;
    }
    CHECK(((sbus::Frame16::flags(frame.data()) & sbus::FlagLostFrame) != 0) ==
          (ms / 9 % 100 == 60 || ms / 9 % 100 == 61));
    Channels channels;
    sbus::unpack(frame.data(), channels.data());
    for (size_t i = 0; i < 18 && ms % PeriodMs >= fromMs && ms % PeriodMs < untilMs; i++) {
      Range &range = ranges[i];
      range.low = std::min<unsigned>(range.low, channels[i]);
      range.high = std::max<unsigned>(range.high, channels[i]);
      range.fastest = std::max(range.fastest, ms == 0 ? 0 : std::abs(channels[i] - last[i]));
    }
    last = channels;
  }
  return ranges;
}

}  // namespace

TEST_CASE(
    "sticks and switches go to both ends, rest at their trims, are held up and right, and then fly gently; CH7 on "
    "stay") {
  const struct {
    unsigned fromMs, untilMs;
    unsigned lows[6], highs[6];
  } rows[] = {
      {0, 14000, {172, 172, 172, 172, 172, 172}, {1811, 1811, 1811, 1811, 1811, 1811}},
      {15000, 22000, {999, 984, 172, 991, 172, 992}, {1001, 986, 172, 993, 172, 992}},
      {23000, 28000, {1811, 172, 1811, 1811, 172, 992}, {1811, 172, 1811, 1811, 172, 992}},
      {29000, 39500, {701, 735, 792, 792, 172, 992}, {1300, 1235, 1192, 1192, 172, 992}},
  };
  for (const auto &row : rows) {
    const std::array<Range, 18> found = ranges(row.fromMs, row.untilMs);
    for (size_t i = 0; i < 18; i++) {
      INFO("from ", row.fromMs, " ms, channel ", i);
      const unsigned standing = i < 16 ? 992 : 0;
      CHECK(found[i].low == (i < 6 ? row.lows[i] : standing));
      CHECK(found[i].high == (i < 6 ? row.highs[i] : standing));
    }
  }
}

TEST_CASE("sticks move by at most 30 a frame, by 90 after two lost frames, also where the calibration begins again") {
  const std::array<Range, 18> found = ranges(0, PeriodMs);
  for (size_t i = 0; i < 4; i++) {
    CHECK(found[i].fastest <= 90);
  }
}
