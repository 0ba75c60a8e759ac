// Frames that may consist of parts of several: when they are rejected, and when they are believed.
#include <doctest/doctest.h>
#include <sbus/JoinCheck.h>

#include <initializer_list>

namespace {

using Join = sbus::JoinCheck<25, true>;

constexpr uint8_t CharacterUs = 120;
constexpr uint16_t FrameUs = 25 * CharacterUs;
constexpr unsigned NoLoss = FrameUs;  // us: a time in which 25 characters come

// Takes a poll that found `found` characters of a frame of which `filled` had come, 0: that begins with them.
void poll(Join &join, unsigned found, unsigned filled, uint32_t before, unsigned interval, bool isStretched = false) {
  join.poll(found, filled == 0, static_cast<uint16_t>(before));
  join.late(interval, found, filled == 0 ? 0 : 25 - filled, CharacterUs, isStretched);
}

bool isJoined(Join &join, uint32_t us, bool isInSync = false) {
  return join.isJoined(static_cast<uint16_t>(us), CharacterUs, false, isInSync);
}

// Takes a poll, and returns what its evidence is worth: how many of 300 crowded frames are rejected that took too long.
int doubtsAfter(unsigned found, unsigned filled, unsigned interval, bool isStretched = false) {
  Join join;
  join.reset();
  poll(join, found, filled, 0, interval, isStretched);
  poll(join, 25, 0, 0, NoLoss, isStretched);
  int count = 0;
  for (int i = 0; i < 300; i++) {
    count += isJoined(join, 20000) ? 1 : 0;
  }
  return count;
}

// An object in doubt.
Join doubting() {
  Join join;
  join.reset();
  poll(join, 3, 10, 0, 2000);
  return join;
}

// Takes a frame of which a poll found `found` characters, and returns true if it is rejected. It took `us`.
bool rejects(Join &join, unsigned found, uint32_t us, bool isInSync = false, uint32_t began = 0xFFFFF000) {
  poll(join, 1, 0, began, CharacterUs);
  poll(join, found, 1, began, found * CharacterUs);
  poll(join, 1, 1 + found, began, CharacterUs);
  return isJoined(join, began + us, isInSync);
}

int rejected(Join &join, int frames, unsigned found, uint32_t us, bool isInSync = false) {
  int count = 0;
  for (int i = 0; i < frames; i++) {
    count += rejects(join, found, us, isInSync) ? 1 : 0;
  }
  return count;
}

}  // namespace

TEST_CASE("a poll raises a doubt for 100 crowded frames if it must have found more") {
  struct Row {
    const char *as;
    unsigned found, filled, mostUs;
    bool isStretched;
  };
  for (const Row &row : {
           Row{"within a frame, and a pause", 3, 10, 3 * 120 + 600, false},
           Row{"likewise, a sender that stretches its frames", 3, 10, 3 * 240 + 600, true},
           Row{"longer than a stop counts: any sender may stretch", 12, 5, 12 * 240 + 600, false},
           Row{"the line has lost three characters of the frame", 3, 19, 3 * 240 + 600 + 13000, false},
           Row{"a frame may begin after a period", 3, 0, 3 * 240 + 600 + 13000, false},
           Row{"a whole frame, and the next", 26, 0, 26 * 120 + 600 + 26000, false},
           Row{"a full port", 63, 0, 63 * 120 + 600 + 39000, false},
       }) {
    CAPTURE(row.as);
    CHECK(doubtsAfter(row.found, row.filled, row.mostUs, row.isStretched) == 0);
    CHECK(doubtsAfter(row.found, row.filled, row.mostUs + 1, row.isStretched) == 100);
  }
}

TEST_CASE("a frame whose polls found two characters at most is no join, however long it took") {
  Join join = doubting();
  for (const unsigned found : {1U, 2U}) {
    CHECK_FALSE(rejects(join, found, FrameUs + 20000));
  }
}

TEST_CASE("after eight crowded frames in a row the time decides: 3.8 ms more than a frame takes, in sync 10 ms") {
  for (const uint32_t began : {0U, 0xFFFFF000U, 60000U}) {
    CAPTURE(began);
    Join join = doubting();
    CHECK_FALSE(rejects(join, 2, FrameUs));
    CHECK(rejected(join, 20, 3, FrameUs) == 8);
    CHECK_FALSE(rejects(join, 3, FrameUs + 3800, false, began));
    CHECK(rejects(join, 3, FrameUs + 3801, false, began));
    CHECK_FALSE(rejects(join, 3, FrameUs + 10000, true, began));
    CHECK(rejects(join, 3, FrameUs + 10001, true, began));
  }
}

TEST_CASE("a sender that stretches its frames takes twice as long") {
  Join join = doubting();
  CHECK_FALSE(rejects(join, 2, FrameUs));
  CHECK(rejected(join, 8, 3, FrameUs) == 8);
  poll(join, 25, 0, 0, NoLoss);
  CHECK_FALSE(join.isJoined(2 * FrameUs + 3800, CharacterUs, true, false));
  CHECK(join.isJoined(2 * FrameUs + 3801, CharacterUs, true, false));
}

TEST_CASE("a late poll that found less than the incomplete frame lacks has lost some of it") {
  Join join;
  join.reset();
  CHECK_FALSE(join.late(3 * 120 + 600, 3, 20, CharacterUs, false));
  CHECK(join.late(3 * 120 + 601, 3, 20, CharacterUs, false));
  CHECK(join.late(3 * 120 + 601, 3, 4, CharacterUs, false));
  CHECK_FALSE(join.late(3 * 120 + 601, 3, 3, CharacterUs, false));
  CHECK_FALSE(join.late(20000, 3, 0, CharacterUs, false));  // no frame was incomplete
  join.trustPort();
  CHECK(join.late(3 * 120 + 601, 3, 20, CharacterUs, false));  // a pause on the line
}

TEST_CASE("without a doubt no frame is joined") {
  Join join;
  join.reset();
  CHECK(rejected(join, 200, 25, 20000) == 0);
  join = doubting();
  join.reset();
  CHECK(rejected(join, 200, 25, 20000) == 0);
}

TEST_CASE("a frame is unplaced if the poll that brings its end comes more than 8 ms after the one before") {
  Join join;
  join.reset();
  CHECK_FALSE(join.isUnplaced());
  poll(join, 25, 0, 0, 8000);
  CHECK_FALSE(join.isUnplaced());
  poll(join, 25, 0, 0, 8001);
  CHECK(join.isUnplaced());
  poll(join, 59, 0, 0, 25000);
  CHECK(join.isUnplaced());
  poll(join, 60, 0, 0, 25000);  // a full port
  CHECK_FALSE(join.isUnplaced());
}

TEST_CASE("a port that tells what it has lost raises no doubt") {
  Join join;
  join.reset();
  join.trustPort();
  poll(join, 3, 10, 0, 20000);
  CHECK_FALSE(join.isUnplaced());
  CHECK(rejected(join, 20, 3, 20000) == 0);
}

TEST_CASE("where the clock runs no frame is rejected") {
  CHECK_FALSE(sbus::JoinCheck<25, false>::isJoined(60000, CharacterUs, false, false));
  CHECK_FALSE(sbus::JoinCheck<25, false>::late(60000, 3, 20, CharacterUs, false));
  CHECK_FALSE(sbus::JoinCheck<25, false>::isUnplaced());
}
