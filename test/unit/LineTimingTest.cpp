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

// A port that answers at once.
template <typename Format>
Silence silenceBefore(LineTiming &line, unsigned found, uint32_t now) {
  return line.silenceBefore<Format>(found, now, now);
}

// A byte came at `now`, and the call after next is empty.
LineTiming afterByte(uint32_t now, uint8_t characterTime = 120, uint8_t idleCharacters = BoardsIdle) {
  LineTiming line = timing(now - 1000, characterTime, idleCharacters);
  line.empty(now - 500);
  silenceBefore<sbus::Frame16>(line, 1, now);
  return line;
}

}  // namespace

TEST_CASE(
    "the shortest time from the last byte to the last empty call that proves a gap, and a wide one, by the bytes found "
    "after it") {
  constexpr uint32_t StopMax = 1500;  // us
  const struct {
    unsigned found;
    unsigned idle;                // characters that the port waits for
    unsigned gap16, gap24, wide;  // characters, for 16 and 24 channels; and StopMax
  } rows[] = {{1, 0, 2, 2, 2},     {16, 0, 2, 2, 2},    {64, 0, 2, 2, 2},     {1, 1, 5, 4, 3},     {1, 4, 8, 7, 6},
              {8, 1, 14, 11, 17},  {9, 1, 15, 12, 19},  {15, 1, 22, 18, 31},  {16, 1, 22, 19, 33}, {16, 4, 22, 19, 36},
              {25, 1, 22, 19, 33}, {64, 1, 22, 19, 33}, {5000, 4, 22, 19, 36}};
  for (const auto &row : rows) {
    for (const uint8_t characterTime : {uint8_t{120}, uint8_t{60}}) {
      for (const uint32_t start : {uint32_t{5000}, UINT32_MAX - 300}) {  // the clock wraps
        INFO("found ", row.found, ", idle ", row.idle, ", characterTime ", unsigned{characterTime}, ", start ", start);
        const auto silence = [&](uint32_t us, bool is24) {
          LineTiming line = afterByte(start, characterTime, static_cast<uint8_t>(row.idle));
          line.empty(start + us);
          const uint32_t later = start + us + 40000;  // proves nothing: loop() may have been blocked
          return is24 ? silenceBefore<sbus::Frame24>(line, row.found, later)
                      : silenceBefore<sbus::Frame16>(line, row.found, later);
        };
        for (const bool is24 : {false, true}) {
          const uint32_t gapUs = (is24 ? row.gap24 : row.gap16) * characterTime;
          const uint32_t wideUs = row.wide * characterTime + StopMax;
          CHECK(silence(gapUs, is24) == Silence::Unknown);
          CHECK(silence(gapUs + 1, is24) == Silence::Gap);
          CHECK(silence(wideUs, is24) == Silence::Gap);
          CHECK(silence(wideUs + 1, is24) == Silence::Wide);
          CHECK(silence(49999, is24) == Silence::Wide);
          CHECK(silence(50000, is24) == Silence::Long);
        }
      }
    }
  }
}

TEST_CASE("without an empty call since the last byte nothing is known, however late the call is") {
  for (const uint32_t us : {1u, 3000u, 20000u, 49999u, 50000u, 4000000000u}) {
    CAPTURE(us);
    LineTiming line = afterByte(1000000);
    CHECK(silenceBefore<sbus::Frame16>(line, 25, 1000000 + us) == Silence::Unknown);
    CHECK(line.silenceAfter<sbus::Frame16>() == Silence::Unknown);
  }
}

TEST_CASE("before the first character the silence is long, and one that outlasts the clock's turn stays long") {
  LineTiming line = timing(7000);
  line.empty(7001);
  CHECK(silenceBefore<sbus::Frame16>(line, 1, 7002) == Silence::Long);
  for (const uint32_t beyond : {0u, 1000u, 49999u, 50000u, 4000000000u}) {
    CAPTURE(beyond);
    line = afterByte(7000);
    uint64_t us = 7000;
    while (us < (uint64_t{1} << 32) + 7000 + beyond) {
      us += 40000;
      line.empty(static_cast<uint32_t>(us));
    }
    CHECK(silenceBefore<sbus::Frame16>(line, 1, static_cast<uint32_t>(us + 1)) == Silence::Long);
  }
}

TEST_CASE(
    "a call is late by more than what it found takes, and a period for each frame that ends meanwhile: it must have "
    "found more") {
  const struct {
    const char *what;
    int found, missing;
    uint8_t idle;  // characters that the port waits for; 0: it hands over each at once
    uint32_t us16, us24, stretched16, stretched24;
  } rows[] = {
      {"3 of a frame that lacks 20", 3, 20, 0, 6 * 120, 5 * 120, 8 * 120, 8 * 120},
      {"of a port that may hold back 16", 3, 20, 1, 27 * 120, 22 * 120, 41 * 120, 41 * 120},
      {"and waits for four characters", 3, 20, 4, 30 * 120, 25 * 120, 44 * 120, 44 * 120},
      {"no frame had begun", 3, 0, 0, 9000 + 6 * 120, 9000 + 5 * 120, 9000 + 8 * 120, 9000 + 8 * 120},
      {"the end of one, and 12 of the next", 32, 20, 0, 9000 + 43 * 120, 9000 + 34 * 120, 9000 + 66 * 120,
       9000 + 66 * 120},
      {"the end of one, a whole one of 16 channels, and 2", 32, 5, 0, 2 * 9000 + 43 * 120, 9000 + 34 * 120,
       2 * 9000 + 66 * 120, 9000 + 66 * 120},
  };
  for (const auto &row : rows) {
    for (const uint32_t start : {uint32_t{5000}, UINT32_MAX - 300}) {  // the clock wraps
      CAPTURE(row.what);
      CAPTURE(start);
      const auto foundTooFew = [&](uint32_t us, bool is24, bool isStretched = false) {
        LineTiming line = afterByte(start, 120, row.idle);
        line.empty(start + 700);
        silenceBefore<sbus::Frame16>(line, static_cast<unsigned>(row.found), start + 700 + us);
        const unsigned interval = line.interval();
        const bool falls = is24 ? line.foundTooFew<sbus::Frame24>(interval, row.found, row.missing, 9000, isStretched)
                                : line.foundTooFew<sbus::Frame16>(interval, row.found, row.missing, 9000, isStretched);
        CHECK((!falls || line.mayHaveFoundTooFew(interval)));
        return falls;
      };
      CHECK_FALSE(foundTooFew(row.us16, false));
      CHECK(foundTooFew(row.us16 + 1, false));
      CHECK_FALSE(foundTooFew(row.us24, true));
      CHECK(foundTooFew(row.us24 + 1, true));
      CHECK_FALSE(foundTooFew(row.stretched16, false, true));
      CHECK(foundTooFew(row.stretched16 + 1, false, true));
      CHECK_FALSE(foundTooFew(row.stretched24, true, true));
      CHECK(foundTooFew(row.stretched24 + 1, true, true));
      for (const uint32_t minutes : {36u, 71u}) {  // beyond the sign bit, and just before the clock wraps
        CHECK(foundTooFew(minutes * 60000000, false));
        CHECK(foundTooFew(minutes * 60000000, true, true));
      }
    }
  }
  CHECK_FALSE(timing(5000).mayHaveFoundTooFew(100000));  // no poll has found nothing
}

TEST_CASE("an empty call proves silence once a burst would have been handed over meanwhile, and a wide one later") {
  const struct {
    uint8_t idle;
    uint32_t gap16, gap24, wide;  // us
  } rows[] = {{0, 2 * 120, 2 * 120, 2 * 120 + 1500},
              {1, 22 * 120, 19 * 120, 33 * 120 + 1500},
              {4, 22 * 120, 19 * 120, 36 * 120 + 1500}};
  for (const auto &row : rows) {
    CAPTURE(unsigned{row.idle});
    LineTiming line = afterByte(1000, 120, row.idle);
    const auto after16 = [&](uint32_t us) {
      line.empty(1000 + us);
      return line.silenceAfter<sbus::Frame16>();
    };
    const auto after24 = [&](uint32_t us) {
      line.empty(1000 + us);
      return line.silenceAfter<sbus::Frame24>();
    };
    CHECK(after16(row.gap16) == Silence::Unknown);
    CHECK(after16(row.gap16 + 1) == Silence::Gap);
    CHECK(after24(row.gap24) == Silence::Unknown);
    CHECK(after24(row.gap24 + 1) == Silence::Gap);
    CHECK(after16(row.wide) == Silence::Gap);
    CHECK(after16(row.wide + 1) == Silence::Wide);
    CHECK(after24(row.wide + 1) == Silence::Wide);
    CHECK(after16(60000) == Silence::Wide);  // the next character tells that it was long
    silenceBefore<sbus::Frame16>(line, 1, 90000);
    CHECK(line.silenceAfter<sbus::Frame16>() == Silence::Unknown);
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
          silenceBefore<sbus::Frame16>(line, row.found, now += row.periodUs);
        }
        return silenceBefore<sbus::Frame16>(line, row.bytes, now + us);
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

TEST_CASE("a port that tells when the line was idle: its bytes took two characters' time each, the rest was silence") {
  const struct {
    unsigned found;
    uint32_t us, silence;  // between two calls
  } rows[] = {{1, 240, 0}, {1, 241, 1}, {16, 3840, 0}, {16, 3841, 1}, {25, 6000, 0}, {25, 9000, 3000}, {25, 0, 0}};
  for (const auto &row : rows) {
    for (const uint32_t before : {uint32_t{5000}, UINT32_MAX - 100}) {  // the clock wraps
      INFO("found ", row.found, ", us ", row.us);
      CHECK(timing(0).silence(row.found, before + row.us, before) == row.silence);
      CHECK(timing(0, 60).silence(row.found, before + row.us / 2, before) == row.silence / 2);
    }
  }
  CHECK(timing(0).shortestGap() == 240);
  CHECK(timing(0, 60).shortestGap() == 120);
}
