// Which looks tell a pause of the line, and which say nothing.
#include "sbus/Pauses.h"

#include <doctest/doctest.h>

#include <vector>

namespace {

struct Look {
  uint32_t us;  // after the look before
  unsigned bytes;
  bool pause;
};

// A look at `now` has found `bytes`; a look at the same time is the same look.
bool pauseBefore(sbus::Pauses &pauses, unsigned bytes, uint32_t now) {
  const uint32_t quiet = pauses.quiet(now);
  return quiet != 0 && pauses.before(bytes, quiet);
}

struct Row {
  doctest::String what;
  std::vector<Look> looks;
};

constexpr unsigned Many = 40;  // looks, after which the length of a pass is known

// `count` times the same look.
std::vector<Look> times(unsigned count, Look look) {
  return std::vector<Look>(count, look);
}

std::vector<Look> operator+(std::vector<Look> left, const std::vector<Look> &right) {
  left.insert(left.end(), right.begin(), right.end());
  return left;
}

// Looks find bytes; passes of loop() that find none are no looks.
const std::vector<Look> FastLoop = times(Many, {120, 1, false});              // byte by byte
const std::vector<Look> Lumps = times(Many, {1920, 16, false});               // 16 at a time, in a loop() of 50 us
const std::vector<Look> SlowLoop = times(Many, {3000, 25, false});            // a solid line in a loop() of 3 ms

const Row Rows[] = {
    {"byte by byte, then 2 ms without any", FastLoop + times(1, {2000, 1, true})},
    {"byte by byte, then 4 ms without any", FastLoop + times(1, {4000, 1, true})},
    {"byte by byte, then two characters late", FastLoop + times(1, {360, 1, false})},
    {"byte by byte, then a lump's time and a lump", FastLoop + times(1, {1920, 16, false})},
    {"in lumps of 16, then 8 ms and a lump", Lumps + times(1, {8000, 16, true})},
    {"in lumps of 16, then 8 ms and nine bytes", Lumps + times(1, {8000, 9, true})},
    {"in lumps of 16, then a lump one character late", Lumps + times(1, {2040, 16, false})},
    {"3 ms loop, one pass without bytes, then 25", SlowLoop + times(1, {6000, 25, true})},
    {"3 ms loop, three passes without bytes, then 25", SlowLoop + times(1, {12000, 25, true})},
    {"3 ms loop, then the bytes of one pass", SlowLoop + times(1, {3000, 25, false})},
    {"fast loop, blocked for 8 ms on a solid line: 64 bytes say nothing", FastLoop + times(1, {8000, 64, false})},
    {"fast loop, blocked for 20 ms, a heap of 64: nothing", FastLoop + times(1, {20000, 64, false})},
    {"fast loop, blocked for 200 ms, a heap of 64: nothing", FastLoop + times(1, {200000, 64, false})},
    {"lumps, blocked for 12 ms, a heap of 50: nothing", Lumps + times(1, {12000, 50, false})},
    {"the same look twice is one look", FastLoop + times(1, {4000, 1, true}) + times(1, {0, 25, false})},
    {"behind a pause the line goes on", FastLoop + times(1, {4000, 1, true}) + times(24, {120, 1, false}) +
                                            times(1, {4000, 1, true}) + times(24, {120, 1, false})},
};

void play(const Row &row, uint32_t start, uint8_t characterTime) {
  sbus::Pauses pauses;
  uint32_t now = start;
  pauses.reset(now, characterTime);
  unsigned number = 0;
  for (const Look &look : row.looks) {
    CAPTURE(row.what);
    CAPTURE(start);
    CAPTURE(number);
    number++;
    now += static_cast<uint32_t>(uint64_t{look.us} * characterTime / 120);
    CHECK(pauseBefore(pauses, look.bytes, now) == look.pause);
    CHECK(pauses.lastLook() == now);
  }
}

}  // namespace

TEST_CASE("looks tell a pause if no lump and no pass of loop() can have kept the bytes back, else not") {
  for (const Row &row : Rows) {
    play(row, 0, 120);
  }
}

TEST_CASE("the same on a clock that wraps at any look") {
  for (const Row &row : Rows) {
    uint32_t before = 0;
    for (const Look &look : row.looks) {
      before += look.us;
      play(row, 0u - before, 120);
      play(row, 1u - before, 120);
    }
  }
}

TEST_CASE("the same at 200000 baud, twice as fast") {
  for (const Row &row : Rows) {
    play(row, 0, 60);
  }
}

TEST_CASE("the shortest time without bytes that tells a pause, and at 200000 baud half of it") {
  const struct {
    doctest::String what;
    Look look;       // over and over, at 100000 baud
    unsigned bytes;  // that come then
    uint32_t us;     // behind so much quiet they come behind a pause
    uint32_t fastUs;
  } rows[] = {
      {"byte by byte, then one", {120, 1, false}, 1, 514, 257},
      {"byte by byte, then half a lump", {120, 1, false}, 8, 1354, 677},
      {"byte by byte, then a lump", {120, 1, false}, 16, 2164, 1082},
      {"1 ms loop, then one", {1000, 8, false}, 1, 1535, 767},
      {"1 ms loop, then the bytes of a pass", {1000, 8, false}, 8, 2375, 1187},
      {"1 ms loop, then a frame", {1000, 8, false}, 25, 3072, 1536},
      {"in lumps, then one", {1920, 16, false}, 1, 2603, 1302},
      {"in lumps, then a lump", {1920, 16, false}, 16, 4021, 2011},
      {"3 ms loop, then one", {3000, 25, false}, 1, 3855, 1927},
      {"3 ms loop, then a frame", {3000, 25, false}, 25, 5134, 2567},
      {"5 ms loop, then a frame", {5000, 42, false}, 25, 7197, 3599},
  };
  for (const auto &row : rows) {
    for (const uint8_t characterTime : {uint8_t{120}, uint8_t{60}}) {
      const uint32_t us = characterTime == 60 ? row.fastUs : row.us;
      const Look shorter = {us - 1, row.bytes, false};
      const Look longer = {us, row.bytes, true};
      for (const Look &last : {shorter, longer}) {
        CAPTURE(row.what);
        CAPTURE(unsigned{characterTime});
        CAPTURE(last.us);
        sbus::Pauses pauses;
        uint32_t now = 0;
        pauses.reset(now, characterTime);
        for (unsigned look = 0; look < Many; look++) {
          now += row.look.us * characterTime / 120;
          CHECK_FALSE(pauseBefore(pauses, row.look.bytes, now));
        }
        CHECK(pauseBefore(pauses, last.bytes, now + last.us) == last.pause);
      }
    }
  }
}

TEST_CASE("a solid line tells no pause, however long the passes of loop() are, up to the contract's 5 ms, or 2.5 ms") {
  for (const uint8_t characterTime : {uint8_t{120}, uint8_t{60}}) {
    for (uint32_t passUs = characterTime; passUs <= 5000u * characterTime / 120; passUs += characterTime / 12) {
      CAPTURE(unsigned{characterTime});
      CAPTURE(passUs);
      sbus::Pauses pauses;
      pauses.reset(0, characterTime);
      uint32_t now = 0;
      uint64_t read = 0;
      for (unsigned look = 0; look < 300; look++) {
        now += passUs;
        const uint64_t there = now / characterTime;
        if (there > read) {
          REQUIRE_FALSE(pauseBefore(pauses, static_cast<unsigned>(there - read), now));
          read = there;
        }
      }
    }
  }
}

TEST_CASE("a look without bytes tells a silence once a lump would have come") {
  const struct {
    uint8_t characterTime;
    uint32_t us;
    bool silence;
  } rows[] = {{120, 0, false}, {120, 120, false}, {120, 1920, false}, {120, 2040, false}, {120, 2041, true},
              {120, 100000, true}, {60, 0, false}, {60, 960, false}, {60, 1020, false}, {60, 1021, true}};
  for (const auto &row : rows) {
    for (const uint32_t start : {uint32_t{0}, UINT32_MAX - 100, UINT32_MAX - 2041}) {
      CAPTURE(unsigned{row.characterTime});
      CAPTURE(row.us);
      CAPTURE(start);
      sbus::Pauses pauses;
      pauses.reset(start, row.characterTime);
      CHECK(pauses.isSilence(pauses.quiet(start + row.us)) == row.silence);
    }
  }
}
