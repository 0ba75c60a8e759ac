// The first frame of a line: after a reset, on a line joined midway, and on lines with frames of other lengths or
// headers.
#include <doctest/doctest.h>

#include "sbus/FrameFinder.h"
#include "sbus2/Slots.h"
#include "support/Feed.h"
#include "support/ShowArrays.h"

namespace {

const Bytes Low = bytesOf(PaperLow.bytes);

// FrSky's 24 channels: 0F, 33 bytes of channels, flags and end. CH17 and CH18 stand where others have flags and end.
Bytes frame36(unsigned number, unsigned flagsPlace, unsigned endPlace, uint8_t next = 0x3E) {
  const Frame beginning = withByte(withByte(neutralFrame(number), 23, flagsPlace), 24, endPlace);
  return bytesOf(beginning) + Bytes{next} + Bytes(8, 0x3E) + Bytes{0x08, 0x00};  // failsafe
}

}  // namespace

TEST_CASE("from a reset on every frame is found, however seldom polls come: the first once the second has begun") {
  for (const uint32_t periodUs : {3000u, 4000u, 9000u, 30000u}) {
    CAPTURE(periodUs);
    Feeder line;
    line.wait(50000);
    Frames sent, found;
    for (unsigned number = 0; number < 12; number++) {
      sent.push_back(plainFrame(number));
      found = found + line.block(periodUs).poll(bytesOf(sent.back()));
      CHECK(found.size() + 1 >= sent.size());
    }
    CHECK(found == sent);
    CHECK(line.finder.counters().discardedBytes == 0);
  }
}

TEST_CASE(
    "where gaps are seen, the first frame begins at a gap, and is not the end of a longer frame that lost characters") {
  for (size_t before = 0; before < 60; before++) {
    for (const bool header : {false, true}) {
      INFO("before ", before, ", header ", header);
      const bool mayBeLonger = before > 1 && before <= 11;
      Feeder line;
      const Frames found = line.settle().feed(Bytes(before, 0x7C) + Low + (header ? Bytes{0x0F, 0x7C} : Bytes{}));
      CHECK(found.empty() == (before > 0 || !header));
      CHECK(line.wait(Feeder::GapUs).waited.empty() == (mayBeLonger || header));
      CHECK(line.feed({0x0F}).empty());
      const bool isFirst = before > 0 && (mayBeLonger || header);
      CHECK(line.feed(part(Low, 1)).empty() == isFirst);
      const bool isOtherSize = before + Low.size() + (header ? 2 : 0) == 36;  // then one of 25 characters is no proof
      CHECK(line.wait(Feeder::GapUs).waited.size() == (isFirst && !isOtherSize));
    }
  }
}

TEST_CASE(
    "after begin(), and after 50 ms of silence, a frame after other characters, without a gap, is not the first") {
  for (const bool isSilent : {false, true}) {
    for (const size_t noise : {0u, 1u, 4u, 10u, 12u}) {
      INFO("isSilent ", isSilent, ", noise ", noise);
      Feeder line;
      if (isSilent) {
        line.settle().feed(Bytes(40, 0x55));
        line.wait(60000);
      }
      line.feed(Bytes(noise, 0x55));
      CHECK(line.feed(Low).empty());
      CHECK(line.feed(Bytes{0x0F} + Bytes(noise == 0 ? 0 : 11, 0x55)).size() == (noise == 0 ? 1 : 0));
    }
  }
}

TEST_CASE("a failsafe frame that is not aligned comes once the line is silent behind it") {
  const Bytes failsafe = bytesOf(FailsafeFrame);
  Feeder line;
  CHECK(line.lock().feed(Bytes{0x55} + failsafe).empty());  // noise hides the gap before it
  CHECK(line.wait(Feeder::GapUs).waited == Frames{FailsafeFrame});
  for (const uint8_t next : {uint8_t{0x0F}, uint8_t{0x2F}, uint8_t{0x00}}) {
    CAPTURE(unsigned{next});
    Feeder without;
    CHECK(without.lock().feed(Bytes{0x55} + failsafe + Bytes{next}).empty());
    CHECK(without.wait(Feeder::GapUs).waited.empty());
  }
  // The rest of a frame, and a frame that has lost as many characters: silence behind them proves nothing.
  for (const size_t lost : {2u, 5u, 11u}) {
    Feeder halves;
    const Frame before = withByte(withByte(plainFrame(5), 25 - lost, 0x0F), 24, 0x00);
    halves.lock().feed(Bytes(10, 0x55) + part(bytesOf(before), 25 - lost) + part(failsafe, 0, 10) +
                       part(failsafe, 10 + lost));
    CHECK(halves.wait(Feeder::GapUs).waited.empty());
    CHECK(halves.feed({0x0F}).empty());
  }
}

// Lines of `make impairment ONLY="S.BUS2, 8 slots after each frame"` at seeds 1, 25, 13 and 4.
TEST_CASE("where no gap is seen, slots and most of the frame behind them are no first frame of an S.BUS2 line") {
  const struct {
    const char *header;  // where that header is
    Bytes slots;         // the last of a group
    Bytes frame;
  } rows[] = {
      {"in the last slot", {0x63, 0x0C, 0xC5, 0xE3, 0x0F, 0x69}, {0x0F, 0xD8, 0x1B, 0x1F, 0x2B, 0xB2, 0xC7, 0x0A, 0x0F,
                                                                  0x7C, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,
                                                                  0x00, 0x00, 0x00, 0x00, 0x00, 0x0F, 0x14}},
      {"in the one before",
       {0xA3, 0xE4, 0xF6, 0x63, 0x0F, 0xC3, 0xE3, 0x04, 0x77},
       {0x0F, 0x80, 0x00, 0x03, 0xFD, 0xD5, 0x8B, 0xD3, 0xE9, 0xBC, 0x62, 0x4B, 0x4E,
        0x67, 0x5A, 0x5A, 0x3F, 0x9D, 0x01, 0x00, 0x0F, 0xC3, 0x2D, 0x00, 0x14}},
      {"in the third last",
       {0xA3, 0x0F, 0x49, 0x63, 0x73, 0x98, 0xE3, 0x9B, 0xF5},
       {0x0F, 0xD4, 0x75, 0xFA, 0x91, 0xEB, 0x44, 0x95, 0xA7, 0x12, 0x96, 0x6A, 0x9C,
        0x5D, 0x57, 0x00, 0x00, 0x0F, 0x25, 0x9C, 0x31, 0xC4, 0xE5, 0x00, 0x14}},
      {"in the fourth last",
       {0x23, 0x85, 0x0F, 0xA3, 0x3A, 0x4F, 0x63, 0xE4, 0xDD, 0xE3, 0x9E, 0xC7},
       {0x0F, 0x9B, 0x40, 0x07, 0x91, 0x49, 0x98, 0x62, 0xCF, 0x17, 0x28, 0xFA, 0xCF,
        0x01, 0x00, 0x0F, 0xE7, 0x85, 0xC3, 0x96, 0xDC, 0x41, 0x30, 0x00, 0x14}},
  };
  const Bytes nextSlots = {0x13, 0x5A, 0x17, 0x93, 0x43, 0x47, 0x53, 0x0D, 0x6D, 0xD3, 0x2D, 0x2D};
  for (const auto &row : rows) {
    for (const size_t burst : {1u, 3u, 16u}) {
      INFO(row.header, ", burst ", burst);
      Feeder line;
      CHECK(line.feed(Bytes(300, 0x55) + row.slots + row.frame + nextSlots, burst).empty());
    }
  }
}

TEST_CASE("still frames of 36 bytes that look like 25 of S.BUS2 with a slot's ID behind are never accepted") {
  for (const unsigned end : {0x04u, 0x14u, 0x24u, 0x34u}) {
    for (uint8_t slot = 0; slot < sbus::SlotCount; slot++) {
      for (const uint32_t loopUs : {50u, 2000u, 5000u}) {
        INFO("end ", end, ", slot ", unsigned{slot}, ", loopUs ", loopUs);
        TimedLine line;
        for (unsigned count = 0; count < 20; count++) {
          line.send(frame36(1, 0x00, end, sbus::slotId(slot))).gap(9000 - 36 * 120);
        }
        CHECK(line.frames(loopUs).empty());
      }
    }
  }
}

TEST_CASE("after frames of 25 bytes one of 36 bytes is accepted at most once, and never if it comes in large bursts") {
  const struct {
    size_t burst;
    unsigned most;
  } rows[] = {{1, 1}, {9, 1}, {16, 0}, {36, 0}};
  for (const auto &row : rows) {
    CAPTURE(row.burst);
    Feeder line;
    line.lock();
    Frames found;
    for (unsigned number = 0; number < 40; number++) {
      found = found + line.feed(frame36(number, 0x03, 0x00), row.burst);
      line.wait(Feeder::GapUs);
    }
    CHECK(found.size() <= row.most);
  }
}
