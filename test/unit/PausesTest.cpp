// Which polls tell a pause of the line, and which say nothing.
#include "sbus/Pauses.h"

#include <doctest/doctest.h>

#include <vector>

namespace {

struct Poll {
  uint32_t us;  // after the poll before
  unsigned bytes;
  bool pause;
};

// A poll at `now` has found `bytes`; a poll at the same time is the same poll.
bool pauseBefore(sbus::Pauses &pauses, unsigned bytes, uint32_t now) {
  const uint32_t quiet = pauses.quiet(now);
  return quiet != 0 && pauses.pauseBefore(bytes, quiet);
}

struct Row {
  doctest::String what;
  std::vector<Poll> polls;
};

constexpr unsigned Many = 40;  // polls, after which the loop period is known

// `count` times the same poll.
std::vector<Poll> times(unsigned count, Poll poll) {
  return std::vector<Poll>(count, poll);
}

std::vector<Poll> operator+(std::vector<Poll> left, const std::vector<Poll> &right) {
  left.insert(left.end(), right.begin(), right.end());
  return left;
}

// Polls find bytes; a loop() that finds none does not poll.
const std::vector<Poll> FastLoop = times(Many, {120, 1, false});              // byte by byte
const std::vector<Poll> Bursts = times(Many, {1920, 16, false});               // 16 at a time, in a loop() of 50 us
const std::vector<Poll> SlowLoop = times(Many, {3000, 25, false});            // a solid line in a loop() of 3 ms

const Row Rows[] = {
    {"in bursts of 16, then 8 ms and nine bytes", Bursts + times(1, {8000, 9, true})},
    {"3 ms loop, three periods without bytes, then 25", SlowLoop + times(1, {12000, 25, true})},
    {"fast loop, blocked for 8 ms on a solid line: 64 bytes say nothing", FastLoop + times(1, {8000, 64, false})},
    {"fast loop, blocked for 20 ms, then 64: nothing", FastLoop + times(1, {20000, 64, false})},
    {"fast loop, blocked for 200 ms, then 64: nothing", FastLoop + times(1, {200000, 64, false})},
    {"bursts, blocked for 12 ms, then 50: nothing", Bursts + times(1, {12000, 50, false})},
    {"the same poll twice is one poll", FastLoop + times(1, {4000, 1, true}) + times(1, {0, 25, false})},
    {"after a pause the line goes on", FastLoop + times(1, {4000, 1, true}) + times(24, {120, 1, false}) +
                                            times(1, {4000, 1, true}) + times(24, {120, 1, false})},
};

void play(const Row &row, uint32_t start, uint8_t characterTime) {
  sbus::Pauses pauses;
  uint32_t now = start;
  pauses.reset(now, characterTime);
  unsigned number = 0;
  for (const Poll &poll : row.polls) {
    INFO(row.what, ", start ", start, ", number ", number);
    number++;
    now += static_cast<uint32_t>(uint64_t{poll.us} * characterTime / 120);
    CHECK(pauseBefore(pauses, poll.bytes, now) == poll.pause);
    CHECK(pauses.lastPoll() == now);
  }
}

}  // namespace

TEST_CASE("polls tell a pause if no burst and no loop period can have kept the bytes back, else not, at either baud rate") {
  for (const Row &row : Rows) {
    play(row, 0, 120);
    play(row, 0, 60);
    uint32_t before = 0;
    for (const Poll &poll : row.polls) {  // the clock wraps at any of them
      before += poll.us;
      play(row, 0u - before, 120);
      play(row, 1u - before, 120);
    }
  }
}

TEST_CASE("the shortest time without bytes that tells a pause, and at 200000 baud half of it") {
  const struct {
    doctest::String what;
    Poll poll;       // over and over, at 100000 baud
    unsigned bytes;  // that come then
    uint32_t us;     // after so much quiet they come after a pause
    uint32_t fastUs;
  } rows[] = {
      {"byte by byte, then one", {120, 1, false}, 1, 514, 257},
      {"byte by byte, then half a burst", {120, 1, false}, 8, 1354, 677},
      {"byte by byte, then a burst", {120, 1, false}, 16, 2164, 1082},
      {"1 ms loop, then one", {1000, 8, false}, 1, 1535, 767},
      {"1 ms loop, then the bytes of a period", {1000, 8, false}, 8, 2375, 1187},
      {"1 ms loop, then a frame", {1000, 8, false}, 25, 3072, 1536},
      {"in bursts, then one", {1920, 16, false}, 1, 2603, 1302},
      {"in bursts, then a burst", {1920, 16, false}, 16, 4021, 2011},
      {"3 ms loop, then one", {3000, 25, false}, 1, 3855, 1927},
      {"3 ms loop, then a frame", {3000, 25, false}, 25, 5134, 2567},
      {"5 ms loop, then a frame", {5000, 42, false}, 25, 7197, 3599},
  };
  for (const auto &row : rows) {
    for (const uint8_t characterTime : {uint8_t{120}, uint8_t{60}}) {
      const uint32_t us = characterTime == 60 ? row.fastUs : row.us;
      const Poll shorter = {us - 1, row.bytes, false};
      const Poll longer = {us, row.bytes, true};
      for (const Poll &last : {shorter, longer}) {
        INFO(row.what, ", characterTime ", unsigned{characterTime}, ", last.us ", last.us);
        sbus::Pauses pauses;
        uint32_t now = 0;
        pauses.reset(now, characterTime);
        for (unsigned poll = 0; poll < Many; poll++) {
          now += row.poll.us * characterTime / 120;
          CHECK_FALSE(pauseBefore(pauses, row.poll.bytes, now));
        }
        CHECK(pauseBefore(pauses, last.bytes, now + last.us) == last.pause);
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
          REQUIRE_FALSE(pauseBefore(pauses, static_cast<unsigned>(there - read), now));
          read = there;
        }
      }
    }
  }
}

TEST_CASE("the line was idle after a burst if the poll came a character later than it takes, and it is no driver's own") {
  const struct {
    unsigned bytes;
    uint32_t us;  // at 100000 baud
    bool idle;
  } rows[] = {{1, 239, false}, {1, 240, true},     {9, 1199, false}, {9, 1200, true},   {25, 3119, false},
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
