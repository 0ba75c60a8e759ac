// Finds frames on lines without faults: what is delivered, what is rejected and how that is counted, what receivers of
// all makes send, and the age and the period of frames.
#include <doctest/doctest.h>

#include <algorithm>
#include <type_traits>

#include "sbus/FrameFinder.h"
#include "sbus2/Slots.h"
#include "support/Feed.h"
#include "support/ShowArrays.h"

static_assert(!std::is_copy_constructible<sbus::FrameFinder>::value, "a copy's pointers would lead into the original");
static_assert(!std::is_copy_assignable<sbus::FrameFinder>::value, "a copy's pointers would lead into the original");

namespace {

const Bytes Low = bytesOf(PaperLow.bytes);

// Frames with and without 0F in the payload.
Frame frameOf(bool neutral, unsigned number, uint8_t end = 0x00) {
  return neutral ? neutralFrame(number, end) : plainFrame(number, end);
}

}  // namespace

struct Discarded : sbus::NoEvents {
  int bytes = 0;
  void discarded(const uint8_t *, int count) { bytes += count; }
};

TEST_CASE("frame() is null before the first frame; reset forgets frames, incomplete frames and counters") {
  Feeder line;
  for (const Bytes &bytes : {part(Low, 0, 24), Low + Bytes(30, 0xA5) + part(Low, 0, 12)}) {
    CHECK(line.finder.frame() == nullptr);
    line.settle().feed(bytes);
    line.finder.reset(line.now, Feeder::CharacterUs);
    CHECK(line.finder.room() == Feeder().finder.room());
    const sbus::Counters &counters = line.finder.counters();
    CHECK(counters.frames + counters.discardedBytes + counters.resyncs + counters.overflows + counters.period == 0);
  }
  CHECK(line.finder.frame() == nullptr);
  CHECK(line.wait(5000).poll(bytesOf(plainFrame(7)) + Bytes{0x0F}) == Frames{plainFrame(7)});
}

TEST_CASE("bytes that a port hands over may wait if they complete no frame, and no silence shows before them") {
  Feeder line;
  const auto mayWait = [&line](unsigned count) { return line.finder.mayWait(count, line.now); };
  CHECK_FALSE(mayWait(16));  // the line before the first byte is unknown
  for (const bool fromCallback : {false, true}) {
    line.finder.pollIdling(8, line.now, fromCallback, false);
    std::copy_n(Low.begin(), 8, line.finder.space());
    line.finder.received(8, 0);
    CHECK_FALSE(mayWait(17));
    line.now += 15 * Feeder::CharacterUs + 16 * Feeder::CharacterUs + 2 * Feeder::CharacterUs;
    CHECK(mayWait(16));
    line.now += 2 * Feeder::CharacterUs;
    CHECK(mayWait(16));
    line.now += 1;
    CHECK(mayWait(16));
    line.now += 2 * Feeder::CharacterUs + 1;
    CHECK_FALSE(mayWait(16));
    line.finder.bytesLost();
    line.finder.reset(line.now, Feeder::CharacterUs);
  }
}

TEST_CASE("each cause of rejection has its counter, and discarded bytes are counted one by one") {
  const struct {
    doctest::String what;
    Bytes bytes;
    unsigned byEnd, byFlags, byExtra;
  } rows[] = {
      {"end byte 55", bytesOf(withByte(plainFrame(5), 24, 0x55)), 1, 0, 0},
      {"flags bit 4", bytesOf(withByte(plainFrame(5), 23, 0x10)), 0, 1, 0},
      {"a byte too many: CH16 stands at the flags", with(plainFrame(5), 7, 0xA5), 0, 1, 0},
      {"the end byte of another variant, and then noise", bytesOf(plainFrame(5, 0x04)) + Bytes{0xA5}, 0, 0, 1},
      {"37 bytes without an end at 24", part(plainFrame(5), 0, 23) + Bytes(14, 0x20), 1, 0, 0},
      {"noise", Bytes(10, 0xA5), 0, 0, 0},
  };
  for (const auto &row : rows) {
    for (const size_t burst : {1u, 16u}) {
      INFO(row.what, ", burst ", burst);
      Feeder line;
      line.lock();
      CHECK(line.feed(row.bytes, burst).empty());
      CHECK(lastFrame(line.finder) == plainFrame(2));  // of lock()
      CHECK(line.wait(Feeder::GapUs).feed(bytesOf(plainFrame(6)), burst) == Frames{plainFrame(6)});
      const sbus::Counters counters = line.counted();
      CHECK(counters.frames == 1);
      CHECK(counters.rejectedByEnd == row.byEnd);
      CHECK(counters.rejectedByFlags == row.byFlags);
      CHECK(counters.rejectedByLength == row.byExtra);
      CHECK(counters.discardedBytes == row.bytes.size());
    }
  }
}

TEST_CASE(
    "a frame that lacks a byte is rejected by its end, which is the next header, or before a wide gap for that gap") {
  for (const size_t burst : {1u, 16u}) {
    for (const uint32_t gapUs : {uint32_t{Feeder::GapUs}, uint32_t{8000}}) {
      INFO("burst ", burst, ", gapUs ", gapUs);
      Feeder line;
      line.lock();
      CHECK(line.feed(without(plainFrame(5), 7), burst).empty());
      CHECK(line.wait(gapUs).feed(bytesOf(plainFrame(6)), burst) == Frames{plainFrame(6)});
      const bool isWide = burst == 1 || gapUs == 8000;  // of 16 characters, a port hands over later
      CHECK(line.counted().rejectedByEnd == !isWide);
      CHECK(line.counted().rejectedByLength == isWide);
      CHECK(line.counted().discardedBytes == 24);
    }
  }
}

TEST_CASE("each of many headers in a row is counted by its cause: 24, or 6 with an end byte and flags, end a search") {
  const struct {
    uint8_t after;  // 25 times, after 25 headers
    size_t burst;
    unsigned byEnd, byFlags;
  } rows[] = {{0x0C, 1, 25, 0}, {0x0C, 16, 25, 0}, {0x0C, 50, 24, 0}, {0x01, 8, 25, 0},
              {0x14, 1, 1, 22}, {0x14, 16, 1, 22}, {0x14, 50, 1, 19}};  // 0F is no end byte, but may be flags
  for (const auto &row : rows) {
    INFO("after ", row.after, ", burst ", row.burst);
    Feeder line;
    CHECK(line.lock().feed(Bytes(25, 0x0F) + Bytes(25, row.after), row.burst).empty());
    CHECK(line.counted().rejectedByEnd == row.byEnd);
    CHECK(line.counted().rejectedByFlags == row.byFlags);
    CHECK(line.counted().discardedBytes == 50);
    CHECK(line.wait(Feeder::GapUs).feed(bytesOf(Neutral.bytes)) == Frames{Neutral.bytes});
  }
}

TEST_CASE("frames are counted by lost-frame and failsafe flag; a frame that is found after missed frames is a resync") {
  Feeder line;
  line.lock();
  for (const unsigned flags : {0x00u, 0x03u, 0x04u, 0x08u, 0x08u, 0x0Cu}) {
    line.feed(bytesOf(withByte(plainFrame(5), 23, flags)));
    line.wait(Feeder::GapUs);
  }
  CHECK(line.counted().frames == 6);
  CHECK(line.counted().lostFrames == 2);
  CHECK(line.counted().failsafeFrames == 3);
  for (unsigned damage = 0; damage < 5; damage++) {
    CAPTURE(damage);
    CHECK(line.counted().resyncs == damage);
    for (const Bytes &bytes : {without(plainFrame(5), 7), bytesOf(plainFrame(6)), bytesOf(plainFrame(7))}) {
      line.feed(bytes);
      line.wait(Feeder::GapUs);
    }
  }
}

TEST_CASE("no byte from before a break completes a frame after it; the complete frame stays, and the next is found") {
  for (const bool neutral : {false, true}) {
    for (size_t torn = 0; torn < 25; torn++) {
      INFO("neutral ", neutral, ", torn ", torn);
      Feeder line;
      line.lock().feed(bytesOf(frameOf(neutral, 0)) + part(frameOf(neutral, 1), 0, torn));
      line.finder.bytesLost();
      CHECK(line.counted().overflows == 1);
      CHECK(line.counted().discardedBytes == torn);
      CHECK(line.feed(part(frameOf(neutral, 2), torn == 0 ? 25 : torn)).empty());
      CHECK(lastFrame(line.finder) == frameOf(neutral, 0));
      const Frames next = {frameOf(neutral, 3), frameOf(neutral, 4)};
      CHECK(line.feed(join(next)) == next);
    }
  }
}

TEST_CASE("the bytes that a break discards are reported as all others: the places of later frames count on it") {
  sbus::FrameFinderOf<sbus::Frame16, Discarded> finder;
  const Frame frame = plainFrame(1);
  finder.poll(12, 20000);
  std::copy_n(frame.begin(), 12, finder.space());
  finder.received(12, 0);
  CHECK(finder.events().bytes == 0);
  finder.bytesLost();
  CHECK(finder.events().bytes == 12);
}

TEST_CASE(
    "all frames of every make are delivered, with flags, telemetry and tail, and then also those of another make") {
  const struct Make {
    const char *name;
    std::vector<uint8_t> ends;
    Bytes telemetry;  // some 2 ms after each 04
  } makes[] = {
      {"Futaba S.BUS, FrSky", {0x00}, {}},
      {"S.BUS2", {0x14, 0x24, 0x34, 0x04}, {}},
      {"S.BUS2, a sensor", {0x14, 0x24, 0x34, 0x04}, {0x03, 0xC0, 0x2E}},
      {"S.BUS2, a sensor's 00", {0x14, 0x24, 0x34, 0x04}, {0x03, 0xC4, 0x00}},
      {"R7003SB", {0x08}, {}},
  };
  const struct {
    bool neutral;
    unsigned flags;  // of every second five frames
    uint64_t gapUs;
    bool answers;  // there is time for telemetry
  } rows[] = {{false, 0x00, 4000, false}, {true, 0x00, 4000, false}, {true, 0x0F, 4000, false},
              {false, 0x04, 12000, true}, {true, 0x00, 12000, true}, {true, 0x0F, 12000, true}};
  for (const Make &first : makes) {
    for (const Make &second : makes) {
      for (const auto &row : rows) {
        TimedLine line;
        Frames sent;
        for (unsigned number = 0; number < 20; number++) {
          const Make &make = number < 10 ? first : second;
          const uint8_t end = make.ends[number % make.ends.size()];
          sent.push_back(withByte(frameOf(row.neutral, number, end), 23, number % 10 < 5 ? 0 : row.flags));
          line.send(sent.back()).send(tailOf(end)).gap(2000);
          line.send(row.answers && end == Sbus2End ? make.telemetry : Bytes{}).gap(row.gapUs - 2000);
        }
        for (const uint32_t loopUs : {50u, 500u, 1000u, 3000u}) {
          INFO(first.name, ", then ", second.name, ", neutral ", row.neutral, ", flags ", row.flags, ", gapUs ",
               row.gapUs, ", loopUs ", loopUs);
          CHECK(line.frames(loopUs) == sent);
        }
      }
    }
  }
}

// A driver drops a character with a wrong parity: STM32L0 (stm32l0_uart.c), AVR.
TEST_CASE("a slot that lacks a character, before a gap that the polls reveal, costs no frame") {
  const Bytes slot = {sbus::slotId(0), 0xC0, 0x2E};
  const struct {
    doctest::String what;
    Bytes between;
  } rows[] = {
      {"whole", slot},
      {"its ID only", part(slot, 0, 1)},
      {"two of its three", part(slot, 0, 2)},
      {"a whole one, then two of three", slot + Bytes{sbus::slotId(1), 0x80}},
  };
  for (const auto &row : rows) {
    for (const size_t burst : {size_t{1}, size_t{3}, size_t{25}}) {
      CAPTURE(row.what);
      CAPTURE(burst);
      Feeder line;
      line.lock(0x04);
      for (unsigned number = 3; number < 8; number++) {
        line.wait(2000).feed(row.between, burst);
        line.wait(Feeder::GapUs);
        CHECK(line.feed(bytesOf(plainFrame(number, 0x04)), burst) == Feeder::Frames{plainFrame(number, 0x04)});
      }
      CHECK(line.counted().discardedBytes == 5 * row.between.size());
    }
  }
}

TEST_CASE("the period is that of the line; a longer interval counts for an eighth") {
  sbus::Counters counters = {};
  constexpr uint32_t Negative = UINT32_MAX;
  const uint32_t rows[][2] = {{Negative, 0}, {9000, 9000}, {17000, 10000}, {2000, 9000}};  // interval, period after it
  for (const auto &row : rows) {
    counters.measure(row[0]);
    CHECK(counters.period == row[1]);
  }
  for (const uint32_t periodUs : {4000u, 9000u, 15000u}) {
    CAPTURE(periodUs);
    Feeder line;
    line.lock();
    for (unsigned number = 0; number < 60; number++) {
      line.wait(periodUs - 3000).feed(bytesOf(plainFrame(number)));
    }
    CHECK(line.finder.counters().period >= periodUs - 8);
    CHECK(line.finder.counters().period <= periodUs + 8);
  }
}

TEST_CASE("a frame behind as much noise as a large buffer can hold has the age of its own poll") {
  for (const size_t noise : {100u, 128u, 129u, 200u, 300u, 480u}) {
    CAPTURE(noise);
    Feeder line;
    const uint32_t before = line.lock().wait(6000).now;
    CHECK(line.block(60000).poll(Bytes(noise, 0x55) + Low + Bytes{0x0F}) == Frames{PaperLow.bytes});
    CHECK(line.finder.frameTime() == before - (4 + 5) * Feeder::CharacterUs);
  }
}

TEST_CASE("a frame behind one that waited has the age of its own poll") {
  Feeder line;
  line.settle().feed(Low);
  const uint32_t before = line.now;
  CHECK(line.block(9000).poll(bytesOf(PaperHigh.bytes) + Bytes{0x0F}).size() == 2);
  CHECK(line.finder.frameTime() == before - (4 + 5) * Feeder::CharacterUs);
}

TEST_CASE(
    "if the bytes behind the second frame make it look older than the first, there is a period only from the third "
    "on") {
  Feeder line;
  REQUIRE(line.settle().feed(Low).empty());
  REQUIRE(line.wait(4000).waited.size() == 1);
  const uint32_t first = line.finder.frameTime();
  CHECK(line.block(41 * Feeder::CharacterUs).poll(Low + part(Low, 0, 16)).size() == 1);
  const uint32_t second = line.finder.frameTime();
  CHECK(second - first == 0u - 5480);
  CHECK(line.finder.counters().period == 0);
  CHECK(line.feed(part(Low, 16)).size() == 1);
  CHECK(line.finder.counters().period == line.finder.frameTime() - second);
}

TEST_CASE("the time over a missed frame counts as two periods, also if it is the first") {
  Feeder line;
  line.settle();
  const Bytes frame = bytesOf(plainFrame(1));
  Bytes other = frame;
  other.back() = 0x55;
  const auto send = [&](const Bytes &bytes) { return line.feed(bytes).size() + line.wait(6000).waited.size(); };
  const struct {
    Bytes bytes;
    size_t frames;
    uint32_t period;  // then
  } rows[] = {{frame, 1, 0}, {other, 0, 0}, {frame, 1, 9000}, {frame, 1, 9000}, {other, 0, 9000}, {frame, 1, 9000}};
  for (const auto &row : rows) {
    CHECK(send(row.bytes) == row.frames);
    CHECK(line.finder.counters().period == row.period);
  }
}
