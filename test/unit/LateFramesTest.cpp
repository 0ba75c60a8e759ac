// Characters that came slowly: when they may be parts of several frames, and when they are believed.
#include <doctest/doctest.h>

#include <initializer_list>

#include <sbus/LateFrames.h>

namespace {

using Late = sbus::LateFrames<true>;

constexpr uint32_t FrameUs = 25 * 120;

}  // namespace

TEST_CASE("characters may be joined once they take a frame period longer than they should") {
  struct Row {
    const char *what;
    uint32_t periodUs;
    uint8_t frames;
    uint32_t shortestUs;  // since the frame may have begun
  };
  const Row rows[] = {
      {"a period of 9 ms counts as 8", 9000, 1, FrameUs + 8000},
      {"a period of 7 ms", 7000, 1, FrameUs + 7000},
      {"no period is known yet", 0, 1, FrameUs + 8000},
      {"a period that was measured between late polls", 30000, 1, FrameUs + 8000},
      {"two frames", 7000, 2, 2 * FrameUs + 14000},
  };
  for (const uint32_t began : {0u, 0xFFFFF000u}) {
    for (const Row &row : rows) {
      CAPTURE(row.what);
      Late late;
      late.beganAfter(began);
      const uint32_t us = row.frames * FrameUs;
      CHECK_FALSE(late.mayBeJoined(began + row.shortestUs - 1, us, row.frames, row.periodUs));
      CHECK(late.mayBeJoined(began + row.shortestUs, us, row.frames, row.periodUs));
      CHECK_FALSE(late.mayBeJoined(began, us, row.frames, row.periodUs));
    }
  }
}

TEST_CASE("the third of such frames in a row is believed, and so are those after it, until one does not follow") {
  Late late;
  for (int i = 0; i < 2; i++) {
    CHECK(late.mustWait(false));
    CHECK(late.mustWait(true));
    CHECK_FALSE(late.mustWait(true));
    CHECK_FALSE(late.mustWait(true));
  }
}

TEST_CASE("where the clock runs nothing is late") {
  CHECK_FALSE(sbus::LateFrames<false>::mayBeJoined(100000, 0, 1, 7000));
  CHECK_FALSE(sbus::LateFrames<false>::mustWait(false));
}
