// Which calls prove a gap of the line, and which prove nothing.
#include <doctest/doctest.h>

#include <initializer_list>

#include "sbus/Frame.h"
#include "sbus/LineTiming.h"

using sbus::LineTiming;
using sbus::Silence;

namespace {

constexpr uint8_t BoardsIdle = 1;
constexpr unsigned Many = 40;  // calls, after which an event-polled sketch's loop period is known

LineTiming timing(uint32_t now, uint8_t characterTime = 120, uint8_t idleCharacters = BoardsIdle) {
  LineTiming timing;
  timing.reset(now, characterTime, idleCharacters);
  return timing;
}

// A byte came at `now`, and the call after next is empty.
LineTiming afterByte(uint32_t now, uint8_t characterTime = 120, uint8_t idleCharacters = BoardsIdle) {
  LineTiming line = timing(now - 1000, characterTime, idleCharacters);
  line.empty(now - 500);
  line.silenceBefore<sbus::Frame16>(1, now);
  return line;
}

}  // namespace

TEST_CASE("the shortest time from the last byte to the last empty call that proves a gap, by the bytes found after it") {
  const struct {
    unsigned found;
    unsigned idle;           // characters that the port waits for
    unsigned us16, us24;     // at 100000 baud, for 16 and 24 channels
  } rows[] = {
      {1, 0, 4 * 120, 3 * 120},    {1, 1, 5 * 120, 4 * 120},     {1, 4, 8 * 120, 7 * 120},
      {8, 1, 14 * 120, 11 * 120},  {9, 1, 15 * 120, 12 * 120},   {15, 1, 22 * 120, 18 * 120},
      {16, 1, 22 * 120, 19 * 120}, {16, 4, 22 * 120, 19 * 120},  {25, 1, 22 * 120, 19 * 120},
      {64, 1, 22 * 120, 19 * 120}, {5000, 4, 22 * 120, 19 * 120}};
  for (const auto &row : rows) {
    for (const uint8_t characterTime : {uint8_t{120}, uint8_t{60}}) {
      for (const uint32_t start : {uint32_t{5000}, UINT32_MAX - 300}) {  // the clock wraps
        INFO("found ", row.found, ", idle ", row.idle, ", characterTime ", unsigned{characterTime}, ", start ", start);
        const auto silence = [&](uint32_t us, bool is24) {
          LineTiming line = afterByte(start, characterTime, static_cast<uint8_t>(row.idle));
          line.empty(start + us);
          const uint32_t later = start + us + 40000;  // proves nothing: loop() may have been blocked
          return is24 ? line.silenceBefore<sbus::Frame24>(row.found, later)
                      : line.silenceBefore<sbus::Frame16>(row.found, later);
        };
        const uint32_t us16 = row.us16 * characterTime / 120;
        const uint32_t us24 = row.us24 * characterTime / 120;
        CHECK(silence(us16, false) == Silence::Unknown);
        CHECK(silence(us16 + 1, false) == Silence::Gap);
        CHECK(silence(us24, true) == Silence::Unknown);
        CHECK(silence(us24 + 1, true) == Silence::Gap);
        CHECK(silence(49999, false) == Silence::Gap);
        CHECK(silence(50000, false) == Silence::Long);
      }
    }
  }
}

TEST_CASE("without an empty call since the last byte nothing is known, however late the call is") {
  for (const uint32_t us : {1u, 3000u, 20000u, 49999u, 50000u, 4000000000u}) {
    CAPTURE(us);
    LineTiming line = afterByte(1000000);
    CHECK(line.silenceBefore<sbus::Frame16>(25, 1000000 + us) == Silence::Unknown);
    CHECK_FALSE(line.isSilent<sbus::Frame16>());
  }
}

TEST_CASE("before the first character the silence is long, and one that outlasts the clock's turn stays long") {
  LineTiming line = timing(7000);
  line.empty(7001);
  CHECK(line.silenceBefore<sbus::Frame16>(1, 7002) == Silence::Long);
  for (const uint32_t beyond : {0u, 1000u, 49999u, 50000u, 4000000000u}) {
    CAPTURE(beyond);
    line = afterByte(7000);
    uint64_t us = 7000;
    while (us < (uint64_t{1} << 32) + 7000 + beyond) {
      us += 40000;
      line.empty(static_cast<uint32_t>(us));
    }
    CHECK(line.silenceBefore<sbus::Frame16>(1, static_cast<uint32_t>(us + 1)) == Silence::Long);
  }
}

TEST_CASE(
    "a call is late by more than what it found takes, and a period for each frame that ends meanwhile: it must have "
    "found more") {
  const struct {
    const char *what;
    int found, missing;
    uint8_t idle;  // characters that the port waits for; 0: it hands over each at once
    uint32_t us16, us24;
  } rows[] = {
      {"3 of a frame that lacks 20", 3, 20, 0, 6 * 120, 5 * 120},
      {"of a port that may hold back 16", 3, 20, 1, 27 * 120, 22 * 120},
      {"and waits for four characters", 3, 20, 4, 30 * 120, 25 * 120},
      {"no frame had begun", 3, 0, 0, 9000 + 6 * 120, 9000 + 5 * 120},
      {"the end of one, and 12 of the next", 32, 20, 0, 9000 + 43 * 120, 9000 + 34 * 120},
      {"the end of one, a whole one of 16 channels, and 2", 32, 5, 0, 2 * 9000 + 43 * 120, 9000 + 34 * 120},
  };
  for (const auto &row : rows) {
    for (const uint32_t start : {uint32_t{5000}, UINT32_MAX - 300}) {  // the clock wraps
      CAPTURE(row.what);
      CAPTURE(start);
      const auto fallsShort = [&](uint32_t us, bool is24) {
        LineTiming line = afterByte(start, 120, row.idle);
        line.empty(start + 700);
        line.silenceBefore<sbus::Frame16>(static_cast<unsigned>(row.found), start + 700 + us);
        const bool falls = is24 ? line.fallsShort<sbus::Frame24>(row.found, row.missing, 9000)
                                : line.fallsShort<sbus::Frame16>(row.found, row.missing, 9000);
        CHECK((!falls || line.mayFallShort()));
        return falls;
      };
      CHECK_FALSE(fallsShort(row.us16, false));
      CHECK(fallsShort(row.us16 + 1, false));
      CHECK_FALSE(fallsShort(row.us24, true));
      CHECK(fallsShort(row.us24 + 1, true));
    }
  }
  CHECK_FALSE(timing(5000).mayFallShort());
}

TEST_CASE("an empty call proves silence once a burst would have been handed over meanwhile") {
  LineTiming line = afterByte(1000);
  line.empty(1000 + 22 * 120);
  CHECK_FALSE(line.isSilent<sbus::Frame16>());
  line.empty(1000 + 22 * 120 + 1);
  CHECK(line.isSilent<sbus::Frame16>());
  line.silenceBefore<sbus::Frame16>(1, 9000);
  CHECK_FALSE(line.isSilent<sbus::Frame16>());
}

TEST_CASE(
    "a byte ended after the call before, less the characters behind it and the silence that a port waits for after "
    "each") {
  LineTiming line = afterByte(1000);
  line.empty(5000);
  line.empty(8000);
  line.silenceBefore<sbus::Frame16>(25, 9000);
  const struct {
    unsigned behind;
    uint32_t us;
  } rows[] = {{0, 8000 - 4 * 120}, {1, 8000 - 9 * 120}, {12, 8000 - 64 * 120}, {16, 8000u - 84 * 120}, {400, 8000u - 84 * 120}};
  for (const auto &row : rows) {
    CAPTURE(row.behind);
    CHECK(line.endedAfter(row.behind) == row.us);
  }
  line.silenceBefore<sbus::Frame16>(25, 12000);  // no empty call between
  CHECK(line.endedAfter(0) == 9000 - 4 * 120);
}

TEST_CASE("no gap is reported on a line without gaps, even of spread characters, whatever burst, loop and phase") {
  const struct {
    unsigned burst, idle;
  } ports[] = {{16, 1}, {1, 0}, {8, 4}, {8, 2}};
  for (const auto &port : ports) {
    for (const uint32_t characterUs : {120u, 160u}) {
      for (uint32_t loopUs = 40; loopUs <= 5000; loopUs += 62) {
        INFO("burst ", port.burst, ", idle ", port.idle, ", characterUs ", characterUs, ", loopUs ", loopUs);
        LineTiming line = timing(0, 120, static_cast<uint8_t>(port.idle));
        uint32_t read = 0;
        for (uint32_t now = loopUs; now < 300000; now += loopUs) {
          const uint32_t there = now / characterUs / port.burst * port.burst;
          if (there == read) {
            line.empty(now);
            continue;
          }
          const Silence silence = line.silenceBefore<sbus::Frame16>(there - read, now);
          REQUIRE((silence == Silence::Unknown || read == 0));
          read = there;
        }
      }
    }
  }
}

TEST_CASE(
    "if no call is ever empty, the shortest time between two calls replaces it, and proves a gap only if it is short") {
  const struct {
    const char *what;
    uint32_t periodUs;  // of the calls, at 100000 baud
    unsigned found;     // by each
    unsigned bytes;     // that come then
    uint32_t us;        // the shortest time that proves a gap before them; 0: none does
    Silence gap;
  } rows[] = {
      {"byte by byte, then one", 120, 1, 1, 961, Silence::Gap},
      {"byte by byte, then a burst", 120, 1, 16, 2761, Silence::Gap},
      {"byte by byte, then more than a burst: loop() was blocked", 120, 1, 18, 0, Silence::Gap},
      {"3 ms loop, then a frame", 3000, 25, 25, 5643, Silence::Gap},
      {"... then what a burst and a loop bring", 3000, 25, 41, 5643, Silence::Gap},
      {"... and one more: loop() was blocked", 3000, 25, 42, 0, Silence::Gap},
      {"5 ms loop, then a frame", 5000, 42, 25, 7645, Silence::Gap},
      {"9 ms loop, then a frame: 4 ms are assumed", 9000, 25, 25, 9000, Silence::Likely},
  };
  for (const auto &row : rows) {
    for (const uint32_t start : {uint32_t{0}, uint32_t{0} - row.periodUs * Many}) {
      INFO(row.what, ", start ", start);
      const auto silence = [&](uint32_t us) {
        LineTiming line = timing(start);
        uint32_t now = start;
        for (unsigned i = 0; i < Many; i++) {
          line.silenceBefore<sbus::Frame16>(row.found, now += row.periodUs);
        }
        return line.silenceBefore<sbus::Frame16>(row.bytes, now + us);
      };
      if (row.us == 0) {
        CHECK(silence(200000) == Silence::Unknown);
      } else {
        CHECK(silence(row.us) == row.gap);
        CHECK(silence(40000) == row.gap);
        CHECK(silence(60000) == Silence::Long);
      }
    }
  }
}
