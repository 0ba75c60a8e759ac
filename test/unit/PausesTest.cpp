// Which polls tell a pause of the line, and which say nothing.
#include <doctest/doctest.h>

#include <initializer_list>

#include "sbus/Pauses.h"

namespace {

constexpr unsigned Many = 40;  // polls, after which the loop period is known
constexpr uint32_t Never = 0;

}  // namespace

TEST_CASE("the shortest time without bytes that tells a pause, half of it at 200000 baud; many bytes tell none") {
  const struct {
    const char *what;
    uint32_t periodUs;  // of the polls, at 100000 baud
    unsigned found;     // by each
    unsigned bytes;     // that come then
    uint32_t us;        // after so much quiet they come after a pause
    uint32_t fastUs;    // at 200000 baud
  } rows[] = {
      {"byte by byte, then one", 120, 1, 1, 514, 257},
      {"byte by byte, then half a burst", 120, 1, 8, 1354, 677},
      {"byte by byte, then a burst", 120, 1, 16, 2164, 1082},
      {"byte by byte, then a full buffer", 120, 1, 64, Never, Never},
      {"1 ms loop, then one", 1000, 8, 1, 1535, 767},
      {"1 ms loop, then the bytes of a period", 1000, 8, 8, 2375, 1187},
      {"1 ms loop, then a frame", 1000, 8, 25, 3072, 1536},
      {"in bursts, then one", 1920, 16, 1, 2603, 1302},
      {"in bursts, then a burst", 1920, 16, 16, 4021, 2011},
      {"in bursts, then two frames", 1920, 16, 50, Never, Never},
      {"3 ms loop, then one", 3000, 25, 1, 3855, 1927},
      {"3 ms loop, then a frame", 3000, 25, 25, 5134, 2567},
      {"5 ms loop, then a frame", 5000, 42, 25, 7197, 3599},
  };
  for (const auto &row : rows) {
    for (const uint8_t characterTime : {uint8_t{120}, uint8_t{60}}) {
      const uint32_t least = characterTime == 60 ? row.fastUs : row.us;
      for (const uint32_t quietUs : {least - 1, least, uint32_t{8000}, uint32_t{200000}}) {
        for (const uint32_t start : {uint32_t{0}, uint32_t{0} - row.periodUs * Many}) {  // the clock wraps
          INFO(row.what, ", characterTime ", unsigned{characterTime}, ", quietUs ", quietUs, ", start ", start);
          sbus::Pauses pauses;
          pauses.reset(start, characterTime);
          const uint32_t periodUs = row.periodUs * characterTime / 120;
          const auto poll = [&](unsigned found, uint32_t us) {
            const uint32_t now = pauses.lastPoll() + us;
            const bool pause = pauses.pauseBefore(found, pauses.quiet(now));
            CHECK(pauses.lastPoll() == now);
            return pause;
          };
          for (unsigned i = 0; i < Many; i++) {
            CHECK_FALSE(poll(row.found, periodUs));
          }
          CHECK(poll(row.bytes, quietUs) == (least != Never && quietUs >= least));
          for (unsigned i = 0; i < Many; i++) {
            CHECK_FALSE(poll(row.found, periodUs));
          }
        }
      }
    }
  }
}

TEST_CASE("a solid line tells no pause, however long the loop period is, up to the contract's 5 ms, or 2.5 ms") {
  for (const uint8_t characterTime : {uint8_t{120}, uint8_t{60}}) {
    for (uint32_t loopUs = characterTime; loopUs <= 5000u * characterTime / 120; loopUs += characterTime / 12) {
      INFO("characterTime ", unsigned{characterTime}, ", loopUs ", loopUs);
      sbus::Pauses pauses;
      pauses.reset(0, characterTime);
      uint32_t now = 0;
      uint64_t read = 0;
      for (unsigned poll = 0; poll < 300; poll++) {
        now += loopUs;
        const uint64_t there = now / characterTime;
        if (there > read) {
          REQUIRE_FALSE(pauses.pauseBefore(static_cast<unsigned>(there - read), pauses.quiet(now)));
          read = there;
        }
      }
    }
  }
}

TEST_CASE("the line was idle after a burst if the poll came a character later, and it is no driver's burst") {
  const struct {
    unsigned bytes;
    uint32_t us;  // at 100000 baud
    bool idle;
  } rows[] = {{1, 239, false},  {1, 240, true},     {9, 1199, false},  {9, 1200, true},   {25, 3119, false},
              {25, 3120, true}, {8, 100000, false}, {16, 2040, false}, {24, 9000, false}, {64, 9000, false}};
  for (const auto &row : rows) {
    for (const uint8_t characterTime : {uint8_t{120}, uint8_t{60}}) {
      INFO("bytes ", row.bytes, ", us ", row.us, ", characterTime ", unsigned{characterTime});
      sbus::Pauses pauses;
      pauses.reset(0, characterTime);
      CHECK(pauses.idleAfter(row.bytes, row.us * characterTime / 120) == row.idle);
    }
  }
}
