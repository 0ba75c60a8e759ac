// The delay between two lines, and what is said of them before it is known.
#include <algorithm>
#include <array>
#include <cstdlib>
#include <functional>
#include <random>
#include <set>
#include <vector>

#include "doctest/doctest.h"
#include "line/compare/Aligner.h"
#include "line/compare/Comparison.h"

namespace {

constexpr int64_t PeriodUs = 9000;

// Frame i of a flight: both channels rest before `moveAt`.
line::Values valuesAt(int i, int moveAt) {
  line::Values values;
  values.count = 16;
  values.raw.fill(992);
  if (i >= moveAt) {
    values.raw[0] = static_cast<uint16_t>(i * 37 % 2000);
    values.raw[1] = static_cast<uint16_t>(i % 2000);
  }
  return values;
}

struct Lines {
  line::Comparison comparison{[](const line::LostSpan &) {}};

  // Puts the frames of both in the order in which they come. `delayUs(i)`: of B's frame.
  template <typename Delay>
  void play(int count, int moveAt, int64_t zeroUs, Delay delayUs) {
    for (int a = 0, b = 0; a < count || b < count;) {
      const int64_t aUs = zeroUs + a * PeriodUs, bUs = zeroUs + b * PeriodUs + delayUs(b);
      const bool isA = b == count || (a < count && aUs <= bUs);
      int &i = isA ? a : b;
      comparison.put(isA ? 0 : 1, isA ? aUs : bUs, valuesAt(i, moveAt));
      i++;
    }
    comparison.finish();
  }
};

}  // namespace

TEST_CASE("lines that have run for an hour: two seconds of their frames tell the delay, not the first few") {
  Lines lines;
  lines.comparison.knownUntil(0, 0);
  lines.comparison.knownUntil(1, 3600000000);
  lines.play(3000, 0, 3600000000, [](int i) { return i < 12 ? 80000 : 1234; });
  const line::Comparison::Counts &counts = lines.comparison.counts();
  CHECK(counts.same >= 2970);
  CHECK(counts.delays.medianUs() == 1234);
}

TEST_CASE("sticks that rest for more than a minute, then move: the delay is found, and nothing is different or lost") {
  for (const int64_t delayUs : {0, 4000, 20000, 40000, 80000, 150000, -20000, -40000, -80000, -150000}) {
    CAPTURE(delayUs);
    Lines lines;
    lines.play(16000, 10000, 1000000, [delayUs](int) { return delayUs; });
    const line::Comparison::Counts &counts = lines.comparison.counts();
    CHECK(lines.comparison.aligner().by() == line::DelayBy::Contents);
    CHECK(counts.different == 0);
    CHECK(counts.lost[0] == 0);
    CHECK(counts.lost[1] == 0);
    CHECK(counts.same >= 15600);
    CHECK(counts.delays.medianUs() == delayUs);
    CHECK(counts.delays.leastUs() == delayUs);
    CHECK(counts.delays.mostUs() == delayUs);
  }
}

TEST_CASE("a port that is late without a sign of that, as at a busy hub: what it brings at once is not lost") {
  constexpr int Begin = 1000;
  for (const int lateFrames : {6, 13, 33, 88}) {
    for (const bool isA : {false, true}) {
      CAPTURE(lateFrames);
      CAPTURE(isA);
      Lines lines;
      lines.play(3000, 0, 1000000, [lateFrames, isA](int i) {
        const int end = Begin + lateFrames;
        const int64_t lateUs = i >= Begin && i < end ? (end - i) * (PeriodUs - 3000) : 0;
        return isA ? -lateUs : lateUs;
      });
      const line::Comparison::Counts &counts = lines.comparison.counts();
      CHECK(counts.same == 3000);
      CHECK(counts.lost[0] == 0);
      CHECK(counts.lost[1] == 0);
      CHECK(counts.delays.medianUs() == 0);
    }
  }
}

TEST_CASE(
    "frames with channels that come again and again are lost, also if the other one loses such a frame soon after") {
  Lines lines;
  for (int i = 0; i < 3000; i++) {
    line::Values values = valuesAt(i, 0);
    if (i > 1000) {
      values.raw[0] = static_cast<uint16_t>(992 + i % 2);
      values.raw[1] = 992;
    }
    for (const size_t side : {size_t{0}, size_t{1}}) {
      const bool isLost = i > 2000 && i % 20 == (side == 0 ? 3 : 7);
      if (!isLost) {
        lines.comparison.put(side, 1000000 + i * PeriodUs, values);
      }
    }
  }
  lines.comparison.finish();
  CHECK(lines.comparison.counts().lost[0] == 50);
  CHECK(lines.comparison.counts().lost[1] == 50);
}

TEST_CASE(
    "ports that hand over their bytes every 16 ms, while sticks rest or alternate: no frame is lost or different") {
  constexpr int Count = 12000;
  constexpr int64_t LatencyUs = 16000, FrameUs = 3000;
  for (const unsigned restValues : {1u, 2u}) {  // how many values CH1 has at rest
    CAPTURE(restValues);
    Lines lines;
    struct Read {
      int64_t us;
      int frame;
    };
    std::array<std::vector<Read>, 2> reads;
    for (const size_t side : {size_t{0}, size_t{1}}) {
      const int64_t phaseUs = side == 0 ? 0 : 5300;
      for (int i = 0; i < Count; i++) {
        const int64_t endUs = 100000 + i * PeriodUs;
        reads[side].push_back({(endUs - phaseUs + LatencyUs - 1) / LatencyUs * LatencyUs + phaseUs, i});
      }
      for (size_t i = reads[side].size() - 1; i-- > 0;) {
        reads[side][i].us = std::min(reads[side][i].us, reads[side][i + 1].us - FrameUs);
      }
    }
    std::mt19937 random(42);
    std::vector<uint16_t> noise(Count);
    std::generate(noise.begin(), noise.end(), [&] { return static_cast<uint16_t>(992 + random() % restValues); });
    std::array<size_t, 2> next{};
    while (next[0] < Count || next[1] < Count) {
      const bool isA = next[1] == Count || (next[0] < Count && reads[0][next[0]].us <= reads[1][next[1]].us);
      const size_t side = isA ? 0 : 1;
      const Read &read = reads[side][next[side]++];
      line::Values values = valuesAt(read.frame, 0);
      if (read.frame > 1000) {
        values.raw[0] = noise[static_cast<size_t>(read.frame)];
        values.raw[1] = 992;
      }
      lines.comparison.put(side, read.us, values, LatencyUs + 12000);
    }
    lines.comparison.finish();
    const line::Comparison::Counts &counts = lines.comparison.counts();
    CHECK(counts.same == Count);
    CHECK(counts.lost[0] == 0);
    CHECK(counts.lost[1] == 0);
    CHECK(std::abs(counts.delays.medianUs()) <= LatencyUs);
  }
}

namespace {

// Two receivers of one radio, of which B was begun `laterUs` after A; each loses one frame in 200. Returns how far off
// the delay is.
int64_t errorOf(Lines &lines, int count, int64_t laterUs, const std::function<line::Values(int)> &valuesOf,
                const std::function<bool(size_t side, int i)> &isLost) {
  std::vector<line::Values> values;
  for (int i = 0; i < count; i++) {
    values.push_back(valuesOf(i));
  }
  lines.comparison.knownUntil(0, 0);
  lines.comparison.knownUntil(1, 0);
  for (int64_t us = 0; us < count * PeriodUs; us += PeriodUs) {  // the two clocks run side by side
    for (const size_t side : {size_t{0}, size_t{1}}) {
      const int i = static_cast<int>((us + (side == 0 ? 0 : laterUs)) / PeriodUs);
      if (i < count && !isLost(side, i)) {
        lines.comparison.put(side, 1000000 + us, values[static_cast<size_t>(i)]);
      }
    }
  }
  lines.comparison.finish();
  return std::abs(lines.comparison.counts().delays.medianUs() + laterUs / PeriodUs * PeriodUs);
}

}  // namespace

TEST_CASE("sticks that move in one frame of a hundred, by a step or two: the delay is found, whichever began first") {
  constexpr int Count = 6600;
  const unsigned seed = 20181;
  CAPTURE(seed);
  std::mt19937 random(seed);
  for (const unsigned restValues : {2u, 3u, 7u}) {
    for (const int64_t laterUs : {0, 900000, 6300000, 18000000, 29700000}) {
      CAPTURE(restValues);
      CAPTURE(laterUs);
      line::Values values = valuesAt(0, 1);
      std::array<std::set<int>, 2> lost;
      for (auto &each : lost) {
        for (int i = 0; i < Count / 200; i++) {
          each.insert(static_cast<int>(random() % Count));
        }
      }
      Lines lines;
      const int64_t errorUs = errorOf(
          lines, Count, laterUs,
          [&](int) {
            if (random() % 100 == 0) {
              values.raw[random() % 2] = static_cast<uint16_t>(992 + random() % restValues);
            }
            return values;
          },
          [&](size_t side, int i) { return lost[side].count(i) > 0; });
      CHECK(errorUs == 0);
      CHECK(lines.comparison.aligner().by() == line::DelayBy::Contents);
      CHECK(lines.comparison.aligner().isCertain());
      CHECK(lines.comparison.counts().different == 0);
    }
  }
}

TEST_CASE("sticks that do not move: nothing tells the delay, which is said") {
  Lines lines;
  errorOf(
      lines, 3000, 900000, [](int) { return valuesAt(0, 1); }, [](size_t, int i) { return i % 100 == 0; });
  CHECK(lines.comparison.aligner().by() == line::DelayBy::Times);
  CHECK_FALSE(lines.comparison.aligner().isCertain());
  CHECK(lines.comparison.aligner().evidence() == "the times alone: not certain");
}

TEST_CASE("a stick that moves to and fro again and again: another delay would agree nearly as well, which is said") {
  Lines lines;
  errorOf(
      lines, 3000, 0,
      [](int i) {
        line::Values values = valuesAt(0, 1);
        values.raw[0] = static_cast<uint16_t>(992 + std::abs(i % 200 - 100));
        return values;
      },
      [](size_t, int) { return false; });
  CHECK_FALSE(lines.comparison.aligner().isCertain());
  CHECK(lines.comparison.aligner().evidence().find("not certain") != std::string::npos);
}

TEST_CASE("the first difference has the switch's name: CH17 and CH18 of 16 channels, DG1 and DG2 of 32") {
  const struct {
    std::array<unsigned, 2> channels;
    size_t which;
    const char *name;
  } rows[] = {
      {{16, 16}, 0, "CH17"}, {{16, 16}, 1, "CH18"}, {{32, 32}, 0, "DG1"}, {{32, 32}, 1, "DG2"}, {{16, 32}, 0, "DG1"}};
  for (const auto &row : rows) {
    CAPTURE(row.name);
    Lines lines;
    for (int i = 0; i < 3000; i++) {
      for (const size_t side : {size_t{0}, size_t{1}}) {
        line::Values values = valuesAt(i, 0);
        values.count = row.channels[side];
        values.switches[row.which] = side == 1 && i == 2000;
        lines.comparison.put(side, 1000000 + i * PeriodUs, values);
      }
    }
    lines.comparison.finish();
    REQUIRE(lines.comparison.counts().first);
    CHECK(lines.comparison.counts().first->name == row.name);
  }
}
