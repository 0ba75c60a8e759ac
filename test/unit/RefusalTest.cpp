// Why the receiver refuses what, how it counts that, and when a frame that it delivers is there.
#include "sbus/Receiver.h"

#include <doctest/doctest.h>

#include "Feed.h"
#include "KnownFrames.h"
#include "ShowArrays.h"

namespace {

// A frame whose CH16 is below 128: its byte 22 could be flags, so its end looks like the middle of a longer one.
Frame lowCh16(unsigned number, uint8_t flags = 0) {
  Channels channels{};
  channels.fill(1024);
  channels[0] = static_cast<uint16_t>(1024 + number);
  channels[15] = 100;
  channels[16] = 0;
  channels[17] = 0;
  Frame frame = writeBitByBit(channels);
  frame[23] = flags;
  return frame;
}

// A receiver that has seen some plain frames, none of which holds 0F in its payload.
struct InLock : Feeder {
  explicit InLock(uint8_t end = 0x00) {
    for (unsigned number = 0; number < 3; number++) {
      REQUIRE(feed(bytesOf(plainFrame(number, end))).size() == 1);
      if (end == 0x08) {
        feed({0x00, 0x03, 0xC0, 0x33, 0x00});
      }
      wait(4000);
    }
  }
};

// Bytes that are held back for the frame that is coming in.
int held(const Feeder &feeder) {
  return Feeder().receiver.room() - feeder.receiver.room();
}

}  // namespace

TEST_CASE("each cause of refusal has its counter, and what belongs to no frame is counted byte by byte") {
  const Bytes longFrame = part(plainFrame(5), 0, 23) + Bytes(11, 0x20) + Bytes{0x00, 0x00};
  const struct {
    doctest::String what;
    Bytes burst;
    unsigned byEnd, byFlags, byExtra;
  } rows[] = {
      {"nothing is wrong", bytesOf(plainFrame(5)), 0, 0, 0},
      {"end byte 55", bytesOf(withByte(plainFrame(5), 24, 0x55)), 1, 0, 0},
      {"end byte 01", bytesOf(withByte(plainFrame(5), 24, 0x01)), 1, 0, 0},
      {"flags bit 4", bytesOf(withByte(plainFrame(5), 23, 0x10)), 0, 1, 0},
      {"flags bit 7", bytesOf(withByte(plainFrame(5), 23, 0x80)), 0, 1, 0},
      {"a byte is missing: the next header stands at the end", without(plainFrame(5), 7), 1, 0, 0},
      {"a byte too many: CH16 stands at the flags", with(plainFrame(5), 7, 0xA5), 0, 1, 0},
      {"a byte too many, CH16 below 128: one more byte belongs to it", with(lowCh16(5), 7, 0xA5), 0, 0, 1},
      {"36 bytes without an end at 24", longFrame, 1, 0, 0},
      {"header 2F is no header at all", bytesOf(withByte(plainFrame(5), 0, 0x2F)), 0, 0, 0},
      {"noise", Bytes(10, 0xA5), 0, 0, 0},
  };
  for (const auto &row : rows) {
    for (const size_t lump : {1u, 16u}) {
      CAPTURE(row.what);
      CAPTURE(lump);
      InLock line;
      const bool good = row.burst == bytesOf(plainFrame(5));
      CHECK(line.feed(row.burst, lump).size() == good);
      line.wait(4000);
      CHECK(line.feed(bytesOf(plainFrame(6)), lump) == Frames{plainFrame(6)});
      const sbus::Counters &counters = line.receiver.counters();
      CHECK(counters.frames == 4 + good);
      CHECK(counters.refusedByEnd == row.byEnd);
      CHECK(counters.refusedByFlags == row.byFlags);
      CHECK(counters.refusedByExtra == row.byExtra);
      CHECK(counters.skippedBytes == (good ? 0 : row.burst.size()));
      CHECK(counters.overflows == 0);
    }
  }
}

TEST_CASE("of many headers in a row each that has no end byte, or no flags, behind it is counted by its cause") {
  const struct {
    uint8_t behind;  // 25 times, behind 25 headers
    unsigned byEnd, byFlags;
  } rows[] = {{0x0C, 25, 0}, {0x01, 25, 0}, {0x14, 1, 23}};  // 0F is no end byte, but may be flags
  for (const auto &row : rows) {
    CAPTURE(row.behind);
    for (const size_t lump : {1u, 16u, 64u}) {
      CAPTURE(lump);
      Feeder line;
      line.receiver.broken();
      CHECK(line.feed(Bytes(25, 0x0F) + Bytes(25, row.behind), lump).empty());
      CHECK(line.receiver.counters().refusedByEnd == row.byEnd);
      CHECK(line.receiver.counters().refusedByFlags == row.byFlags);
      CHECK(line.receiver.counters().skippedBytes == 50);
    }
  }
}

TEST_CASE("lost-flag and failsafe frames are counted, each by its flag") {
  Feeder line;
  for (unsigned flags = 0; flags < 16; flags++) {
    line.feed(bytesOf(withByte(plainFrame(flags), 23, flags)));
    line.idle();
    line.wait(1000);
  }
  CHECK(line.receiver.counters().frames == 16);
  CHECK(line.receiver.counters().lostFrames == 8);
  CHECK(line.receiver.counters().failsafeFrames == 8);
}

TEST_CASE("a resynchronisation is counted when frames are found again, once for each damage") {
  InLock line;
  CHECK(line.receiver.counters().resyncs == 0);
  for (unsigned damage = 0; damage < 5; damage++) {
    CAPTURE(damage);
    CHECK(line.receiver.counters().resyncs == damage);
    line.feed(without(plainFrame(5), 7));
    line.wait(4000);
    line.feed(bytesOf(plainFrame(6)));
    line.wait(4000);
    line.feed(bytesOf(plainFrame(7)));
    line.wait(4000);
  }
}

TEST_CASE("bytes fed == 25 a frame + bytes skipped + bytes held, at every byte of a line with everything on it") {
  Bytes line = Bytes(7, 0xA5) + part(neutralFrame(0), 9);
  for (unsigned number = 0; number < 60; number++) {
    const Frame frame = neutralFrame(number, number < 40 ? 0x00 : 0x08);
    line = line + (number % 7 == 3   ? without(frame, number % 25)
                   : number % 7 == 5 ? with(frame, number % 25, 0x0F)
                                     : bytesOf(frame));
    line = line + (number < 40 ? Bytes{} : Bytes{0x00, 0x03, 0xC0, 0x33, 0x00});
  }
  Feeder feeder;
  for (size_t fed = 1; fed <= line.size(); fed++) {
    feeder.feed({line[fed - 1]});
    const sbus::Counters &counters = feeder.receiver.counters();
    REQUIRE(fed == 25 * counters.frames + counters.skippedBytes + static_cast<unsigned>(held(feeder)));
  }
}

TEST_CASE("the very first 25 bytes, a whole frame, are delivered at once") {
  for (const KnownFrame &known : KnownFrames) {
    for (const size_t lump : {1u, 16u, 25u}) {
      CAPTURE(known.source);
      CAPTURE(lump);
      Feeder line;
      CHECK(line.feed(part(known.bytes, 0, 24), lump).empty());
      CHECK(line.feed(part(known.bytes, 24)) == Frames{known.bytes});
    }
  }
}

TEST_CASE("in lock a frame is delivered with its 25th byte, whatever flags come or go") {
  for (unsigned flags = 0; flags < 16; flags++) {
    CAPTURE(flags);
    for (const bool neutral : {false, true}) {
      CAPTURE(neutral);
      Feeder line;
      for (unsigned number = 0; number < 6; number++) {
        CAPTURE(number);
        const unsigned now = number % 3 == 2 && flags != 0x0F ? flags : 0;  // 0F at this place may be a header
        const Frame frame = withByte(neutral ? neutralFrame(0) : plainFrame(0), 23, now);
        CHECK(line.feed(part(frame, 0, 24)).empty());
        CHECK(line.feed(part(frame, 24)) == Frames{frame});
        line.wait(4000);
      }
    }
  }
}

TEST_CASE("a frame with a CH16 below 128 waits, for the next header, or for a later look without bytes") {
  const struct {
    doctest::String what;
    bool look;
    uint32_t us;
    Bytes bytes;
    bool delivered;
  } rows[] = {
      {"a look at once", true, 0, {}, false},
      {"a look 100 us later", true, 100, {}, false},
      {"a look 4 ms later", true, 4000, {}, true},
      {"the next header, at once", false, 0, {0x0F}, true},
      {"the next header, 4 ms later", false, 4000, {0x0F}, true},
      {"a header 2F, at once", false, 0, {0x2F}, true},
      {"a header 2F, 4 ms later", false, 4000, {0x2F}, true},
      {"the next header and what follows it", false, 4000, {0x0F, 0x00, 0x04}, true},
      {"another 00 at once: it belongs to the frame", false, 0, {0x00}, false},
  };
  for (const auto &row : rows) {
    CAPTURE(row.what);
    Feeder line;
    line.feed(bytesOf(lowCh16(0)));
    line.feed(bytesOf(lowCh16(1)));
    line.wait(4000);
    line.feed(bytesOf(lowCh16(2)));
    line.idle();
    const uint32_t before = line.receiver.counters().frames;
    REQUIRE(before == 3);
    REQUIRE(line.feed(bytesOf(lowCh16(3))).empty());
    line.wait(row.us);
    const Frames found = row.look ? line.look({}) : line.feed(row.bytes);
    CHECK(found == (row.delivered ? Frames{lowCh16(3)} : Frames{}));
  }
}

TEST_CASE("where nothing is known of the line a frame is delivered by a header behind it, 0F or 2F, and by nothing else") {
  for (unsigned next = 0; next < 256; next++) {
    CAPTURE(next);
    Feeder line;
    line.receiver.broken();
    REQUIRE(line.feed(bytesOf(plainFrame(0))).empty());
    const bool header = next == 0x0F || next == 0x2F;
    CHECK(line.feed({static_cast<uint8_t>(next)}) == (header ? Frames{plainFrame(0)} : Frames{}));
  }
}

TEST_CASE("behind a break nothing completes a frame from before it, and the complete one stays") {
  for (const bool neutral : {false, true}) {
    for (size_t torn = 1; torn < 25; torn++) {
      CAPTURE(neutral);
      CAPTURE(torn);
      const auto frame = [neutral](unsigned number) { return neutral ? neutralFrame(number) : plainFrame(number); };
      Feeder line;
      line.feed(bytesOf(frame(0)));
      line.feed(part(frame(1), 0, torn));
      line.receiver.broken();
      CHECK(lastFrame(line.receiver) == frame(0));
      CHECK(line.feed(part(frame(2), torn)).empty());
      CHECK(lastFrame(line.receiver) == frame(0));
      CHECK(line.feed(bytesOf(frame(3)) + bytesOf(frame(4)) + Bytes{0x0F}) == Frames{frame(3), frame(4)});
    }
  }
}

TEST_CASE("a frame that waited is as old as the look that brought its last byte, whatever lets it go, however late") {
  const struct {
    doctest::String what;
    Bytes bytes;
  } rows[] = {
      {"a look without bytes", {}},
      {"the next header", {0x0F}},
      {"the next frame", bytesOf(plainFrame(2))},
      {"noise", {0x55}},
  };
  for (const auto &row : rows) {
    CAPTURE(row.what);
    Feeder line;
    line.feed(bytesOf(lowCh16(0)));
    line.wait(4000);
    REQUIRE(line.feed(bytesOf(lowCh16(1)), 25).empty());
    const uint32_t came = line.now;
    line.wait(10000000);
    line.look(row.bytes);
    REQUIRE(line.receiver.counters().frames >= 2);
    if (line.receiver.counters().frames == 2) {
      CHECK(line.receiver.frameTime() == came);
    }
  }
}

TEST_CASE("frames that wait for the next header do not change the measured period") {
  Feeder line;
  for (unsigned number = 0; number < 60; number++) {
    line.feed(bytesOf(lowCh16(number)), 25);
    line.wait(9000 - 25 * Feeder::CharacterUs);
  }
  CHECK(line.receiver.counters().frames >= 58);
  CHECK(line.receiver.counters().period >= 8990);
  CHECK(line.receiver.counters().period <= 9010);
}

TEST_CASE("a frame that waits when the line breaks is not delivered by what follows the break") {
  Feeder line;
  line.feed(bytesOf(lowCh16(0)));
  line.idle();
  REQUIRE(line.feed(bytesOf(lowCh16(1))).empty());
  line.receiver.broken();
  CHECK(line.idle().empty());
  CHECK(line.feed({0x0F}).empty());
}

TEST_CASE("a break between two frames costs none") {
  Feeder line;
  line.feed(bytesOf(plainFrame(0)));
  line.receiver.broken();
  CHECK(line.feed(bytesOf(plainFrame(1)) + bytesOf(plainFrame(2)) + Bytes{0x0F}) == Frames{plainFrame(1), plainFrame(2)});
}

TEST_CASE("reset forgets frames, halves of frames and counters") {
  InLock line;
  line.feed(Bytes(30, 0xA5) + part(plainFrame(5), 0, 12));
  line.receiver.reset(line.now, Feeder::CharacterUs);
  CHECK(line.receiver.frame() == nullptr);
  CHECK(held(line) == 0);
  const sbus::Counters &counters = line.receiver.counters();
  CHECK(counters.frames == 0);
  CHECK(counters.skippedBytes == 0);
  CHECK(counters.resyncs == 0);
  CHECK(counters.period == 0);
  CHECK(line.feed(bytesOf(plainFrame(7))) == Frames{plainFrame(7)});
}

// `period`: the time between frames, smoothed. Real periods, in us, and loops.
TEST_CASE("the period is that of the line, within the length of a pass and a lump") {
  for (const uint32_t periodUs : {4000u, 6000u, 7000u, 9000u, 14000u, 15000u}) {
    for (const uint32_t loopUs : {50u, 1000u}) {
      CAPTURE(periodUs);
      CAPTURE(loopUs);
      Wire wire;
      for (unsigned number = 0; number < 100; number++) {
        wire.send(plainFrame(number)).pause(periodUs - 3000);
      }
      Feeder feeder;
      wire.play(feeder, loopUs);
      const uint32_t period = feeder.receiver.counters().period;
      CHECK(period >= periodUs - loopUs - 200);
      CHECK(period <= periodUs + loopUs + 200);
    }
  }
}
