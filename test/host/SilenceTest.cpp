// A time without frames: a silence of the line, or a PC that was late.
#include <doctest/doctest.h>

#include "line/Silence.h"

TEST_CASE("a time without frames is a silence unless the lateness of the read after it explains it") {
  using line::Gap;
  struct {
    uint64_t beforeUs, us, lateUs, limitUs;
    Gap gap;
  } const table[] = {
      {5000, 14000, 0, line::SilenceUs, Gap::Ordinary},
      {5000, 105000, 0, line::SilenceUs, Gap::Ordinary},
      {5000, 105001, 0, line::SilenceUs, Gap::Silent},
      {5000, 105001, 99999, line::SilenceUs, Gap::Silent},  // an adapter and a picture's time: the PC was not busy
      {5000, 105001, 100000, line::SilenceUs, Gap::Late},
      {5000, 742000, 737550, line::SilenceUs, Gap::Late},
      {5000, 842551, 737550, line::SilenceUs, Gap::Silent},  // 0.1 s and more before the PC was late
      {5000, 3005001, 0, 3000000, Gap::Silent},              // rows of a board
      {5000, 3005001, 318000, 3000000, Gap::Late},
      {5000, 3005001, 318000, 2000000, Gap::Silent},
  };
  for (const auto &each : table) {
    CAPTURE(each.us);
    CAPTURE(each.lateUs);
    CHECK(line::gapOf(each.beforeUs, each.us, each.lateUs, each.limitUs) == each.gap);
  }
}
