// The simulated receiver's line for a calibration sketch: what the person at the radio does, and when.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>

#include "support/BitByBit.h"
#include "support/ShowArrays.h"
#include "line/SimulatedReceiver.h"

namespace {

constexpr unsigned PeriodMs = 40000;

// Calls `each(ms, channels)` for each frame that the radio has sent, up to but without `untilMs`; those that were lost
// repeat old channels. Returns how many these were.
template <typename Each>
unsigned play(unsigned untilMs, Each each) {
  line::SimulatedReceiver line(line::CalibrationMoves);
  unsigned lost = 0;
  for (unsigned ms = 0; ms < untilMs; ms += 9) {
    Frame frame{};
    for (uint8_t &byte : frame) {
      line::Character character;
      line.next(UINT64_MAX, character);
      byte = character.value;
    }
    if (sbus::lostFrame(frame.data())) {
      lost++;
      continue;
    }
    Channels channels;
    sbus::unpack(frame.data(), channels.data());
    each(ms, channels);
  }
  return lost;
}

struct Range {
  unsigned low = 2047;
  unsigned high = 0;
};

// The range of each channel from one time to the other, in two rounds.
std::array<Range, 18> ranges(unsigned fromMs, unsigned untilMs) {
  std::array<Range, 18> ranges;
  play(2 * PeriodMs, [&](unsigned ms, const Channels &channels) {
    for (size_t i = 0; i < 18 && ms % PeriodMs >= fromMs && ms % PeriodMs < untilMs; i++) {
      ranges[i].low = std::min<unsigned>(ranges[i].low, channels[i]);
      ranges[i].high = std::max<unsigned>(ranges[i].high, channels[i]);
    }
  });
  return ranges;
}

// How often a channel comes to `value` from elsewhere in the first 14 s.
unsigned arrivals(size_t channel, unsigned value) {
  unsigned count = 0;
  unsigned last = value;
  play(14000, [&](unsigned, const Channels &channels) {
    count += channels[channel] == value && last != value;
    last = channels[channel];
  });
  return count;
}

}  // namespace

TEST_CASE("in the first 14 s every stick is at either end a few times, and every switch in all its positions") {
  const struct {
    size_t channel;
    unsigned value, least, most;
  } rows[] = {{0, 172, 3, 99}, {0, 1811, 3, 99}, {1, 172, 3, 99}, {1, 1811, 3, 99}, {2, 172, 3, 99},
              {2, 1811, 3, 99}, {3, 172, 3, 99}, {3, 1811, 3, 99}, {4, 172, 4, 4},  {4, 1811, 5, 5},
              {4, 992, 0, 0},   {5, 172, 4, 4},  {5, 992, 4, 4},   {5, 1811, 4, 4}};
  for (const auto &row : rows) {
    INFO("channel ", row.channel, ", value ", row.value);
    CHECK(arrivals(row.channel, row.value) >= row.least);
    CHECK(arrivals(row.channel, row.value) <= row.most);
  }
}

TEST_CASE("then sticks rest at their trims, the throttle low, are held up and right, and at last fly gently; CH7.. stand") {
  const struct {
    size_t channel;
    unsigned restLow, restHigh, held;
  } rows[] = {{0, 999, 1001, 1811}, {1, 984, 986, 172}, {2, 172, 172, 1811},
              {3, 991, 993, 1811},  {4, 172, 172, 172}, {5, 992, 992, 992}};
  const std::array<Range, 18> rest = ranges(15000, 22000);
  const std::array<Range, 18> held = ranges(23000, 28000);
  const std::array<Range, 18> flight = ranges(29000, 39500);
  for (const auto &row : rows) {
    CAPTURE(row.channel);
    CHECK(rest[row.channel].low == row.restLow);
    CHECK(rest[row.channel].high == row.restHigh);
    CHECK(held[row.channel].low == row.held);
    CHECK(held[row.channel].high == row.held);
    if (row.channel < 4) {
      CHECK(flight[row.channel].low >= 992 - 310);
      CHECK(flight[row.channel].low < 992 - 150);
      CHECK(flight[row.channel].high > 992 + 150);
      CHECK(flight[row.channel].high <= 992 + 310);
    }
  }
  const std::array<Range, 18> all = ranges(0, PeriodMs);
  for (size_t channel = 6; channel < 18; channel++) {
    CHECK(all[channel].low == (channel < 16 ? 992 : 0));
    CHECK(all[channel].high == (channel < 16 ? 992 : 0));
  }
}

TEST_CASE("hands glide: no stick moves by more than 30 in 9 ms, not where it begins again either; two frames in 100 are lost") {
  Channels last{};
  unsigned lastMs = 0;
  unsigned frames = 0;
  unsigned jumps = 0;
  play(2 * PeriodMs, [&](unsigned ms, const Channels &channels) {
    for (size_t i = 0; i < 4 && frames > 0; i++) {
      const int step = channels[i] - last[i];
      jumps += std::max(step, -step) > static_cast<int>(30 * (ms - lastMs) / 9);
    }
    last = channels;
    lastMs = ms;
    frames++;
  });
  CHECK(frames > 8000);
  CHECK(jumps == 0);
  CHECK(play(9 * 1000, [](unsigned, const Channels &) {}) == 20);
}
