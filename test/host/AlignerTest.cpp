// The delay between two lines, and what is said of them before it is known.
#include <string>
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
  line::Aligner aligner{[this](int64_t us, const line::Alignment &found) { comparison.put(us, found); }};

  // Puts the frames of both in the order in which they come. `delayUs(i)`: of B's frame.
  template <typename Delay>
  void play(int count, int moveAt, int64_t zeroUs, Delay delayUs) {
    for (int a = 0, b = 0; a < count || b < count;) {
      const int64_t aUs = zeroUs + a * PeriodUs, bUs = zeroUs + b * PeriodUs + delayUs(b);
      const bool isA = b == count || (a < count && aUs <= bUs);
      int &i = isA ? a : b;
      aligner.put(isA ? 0 : 1, isA ? aUs : bUs, valuesAt(i, moveAt));
      i++;
    }
    aligner.finish();
    comparison.finish();
  }
};

}  // namespace

TEST_CASE("lines that have run for an hour: two seconds of their frames tell the delay, not the first few") {
  Lines lines;
  lines.aligner.knownUntil(0, 0);
  lines.aligner.knownUntil(1, 3600000000);
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
    CHECK(lines.aligner.isByContents());
    CHECK(counts.different == 0);
    CHECK(counts.lost[0] == 0);
    CHECK(counts.lost[1] == 0);
    CHECK(counts.same >= 15600);
    CHECK(counts.delays.medianUs() == delayUs);
    CHECK(counts.delays.leastUs() == delayUs);
    CHECK(counts.delays.mostUs() == delayUs);
  }
}
