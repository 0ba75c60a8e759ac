// The age of a frame, and the period of frames.
#include <doctest/doctest.h>

#include "sbus/FrameFinder.h"
#include "support/Feed.h"
#include "support/ShowArrays.h"

namespace {

const Bytes Low = bytesOf(PaperLow.bytes);

}  // namespace

TEST_CASE(
    "a frame's age counts from the last poll without its end, or what a port holds back before; a blocked loop adds") {
  constexpr uint32_t Idle = 4 * Feeder::CharacterUs;
  for (const uint32_t start : {uint32_t{0}, UINT32_MAX - 50000}) {
    CAPTURE(start);
    Feeder line(start);
    line.lock();
    uint32_t before = line.now;
    CHECK(line.block(3000).poll(Low).size() == 1);
    CHECK(line.finder.frameTime() == before - Idle);
    before = line.wait(6000).now;
    CHECK(line.block(20).poll(Low).size() == 1);
    CHECK(line.finder.frameTime() == before - Idle);
    before = line.wait(6000).now;
    CHECK(line.block(10000000).poll(Low + Low).size() == 2);
    CHECK(line.finder.frameTime() == before - Idle);  // also of the second
    before = line.wait(6000).now;
    CHECK(line.block(10000000).poll(join(Frames(20, PaperLow.bytes))).size() == 20);
    CHECK(line.finder.frameTime() == before - Idle);  // and the last of as many as 512 bytes hold
    before = line.wait(6000).now;
    CHECK(line.block(20).poll(Low + part(Low, 0, 3)).size() == 1);
    CHECK(line.finder.frameTime() == before - Idle - 3 * 5 * Feeder::CharacterUs);  // a port may have waited for each of these
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

TEST_CASE("a frame behind as much noise as a large buffer can hold has the age of its own poll") {
  for (const size_t noise : {100u, 128u, 129u, 200u, 300u, 480u}) {
    CAPTURE(noise);
    Feeder line;
    const uint32_t before = line.lock().wait(6000).now;
    CHECK(line.block(60000).poll(Bytes(noise, 0x55) + Low + Bytes{0x0F}) == Frames{PaperLow.bytes});
    CHECK(line.finder.frameTime() == before - (4 + 5) * Feeder::CharacterUs);
  }
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

TEST_CASE("a frame behind one that waited has the age of its own poll") {
  Feeder line;
  line.settle().feed(Low);
  const uint32_t before = line.now;
  CHECK(line.block(9000).poll(bytesOf(PaperHigh.bytes) + Bytes{0x0F}).size() == 2);
  CHECK(line.finder.frameTime() == before - (4 + 5) * Feeder::CharacterUs);
}

TEST_CASE("the age of a frame that waited counts from the last poll without its end") {
  for (const uint32_t start : {uint32_t{0}, UINT32_MAX - 5000}) {
    for (const bool silence : {false, true}) {
      INFO("start ", start, ", silence ", silence);
      Feeder line(start);
      CHECK(line.settle().feed(Low).empty());
      const uint32_t before = line.now - Feeder::CharacterUs;
      CHECK((silence ? line.wait(14000).waited : line.feed({0x0F})).size() == 1);
      CHECK(line.finder.frameTime() == before - 4 * Feeder::CharacterUs);
    }
  }
}
