// Finds frames on an impaired line: one fault costs one frame, and every frame that is delivered was on the line.
// test/impairment shows the same for random faults.
#include <doctest/doctest.h>

#include "sbus/FrameFinder.h"
#include "support/Feed.h"
#include "support/ShowArrays.h"

namespace {

const Frames Two = {Neutral.bytes, PaperHigh.bytes};

constexpr uint32_t GapUs = Feeder::GapUs;

Frames neutralFrames(unsigned count) {
  Frames frames;
  for (unsigned number = 0; number < count; number++) {
    frames.push_back(neutralFrame(number));
  }
  return frames;
}

}  // namespace

TEST_CASE(
    "garbage, a byte too many, or the rest of a frame before the first one cost no frame once 50 characters show no "
    "gap") {
  std::vector<Bytes> rows = {
      {0x00}, {0xA5, 0x5A, 0xFF}, Bytes(100, 0xFF), {0x0F}, {0x0F, 0x0F, 0x0F}, {0xA5, 0x0F, 0xA5}, Bytes(23, 0x0F)};
  for (size_t index = 1; index < 25; index++) {
    rows.push_back(part(Neutral.bytes, index));
  }
  for (size_t index = 2; index <= 22; index++) {
    rows.push_back(with(PaperLow.bytes, index, 0x0F));
  }
  for (const Bytes &garbage : rows) {
    for (const size_t burst : {1u, 16u, 64u}) {
      for (const bool byEvents : {false, true}) {
        INFO("garbage.size() ", garbage.size(), ", burst ", burst, ", byEvents ", byEvents);
        const Frames found = feedNew(garbage + join(Two), burst, byEvents);
        CHECK((found == Two || (garbage.size() < 25 && found == Frames{Two.back()})));
      }
    }
  }
}

TEST_CASE(
    "after a break at any character, failsafe frames, which allow a false sync, wait for a gap, and none is a false "
    "sync") {
  for (const size_t burst : {1u, 16u, 25u}) {
    for (size_t missing = 0; missing < 25; missing++) {
      INFO("burst ", burst, ", missing ", missing);
      Feeder line;
      line.lock().feed(bytesOf(FailsafeFrame), burst);
      line.finder.broken();
      Bytes bytes = part(FailsafeFrame, missing);
      for (unsigned number = 0; number < 20; number++) {
        bytes = bytes + bytesOf(FailsafeFrame);
      }
      CHECK(line.feed(bytes, burst).empty());
      CHECK(line.wait(GapUs).waited == Frames{FailsafeFrame});
      CHECK(line.feed(bytesOf(FailsafeFrame), burst) == Frames{FailsafeFrame});
    }
  }
}

TEST_CASE("up to 12 bytes lost at any place of a neutral frame cost that frame and no other, and none is wrong") {
  const Frames before = neutralFrames(3);
  const Frames after = {neutralFrame(4), neutralFrame(5), neutralFrame(6), neutralFrame(7)};
  const Frame damaged = neutralFrame(3);
  for (size_t lost = 1; lost <= 12; lost++) {
    for (size_t index = 0; index + lost <= 25; index++) {
      const Bytes bytes = part(damaged, 0, index) + part(damaged, index + lost);
      TimedLine line;
      for (unsigned number = 0; number < 8; number++) {
        line.send(number == 3 ? bytes : bytesOf(neutralFrame(number))).gap(GapUs);
      }
      for (const uint32_t loopUs : {50u, 3000u}) {
        INFO("lost ", lost, ", index ", index, ", loopUs ", loopUs);
        CHECK(line.frames(loopUs) == before + after);
      }
      // Without a gap the frame before a lost header has 24 characters after it: it may be part of a longer one.
      for (const size_t burst : {1u, 5u, 16u, 25u, 64u}) {
        INFO("index ", index, ", burst ", burst);
        CHECK((lost > 1 || index == 0 || feedNew(join(before) + bytes + join(after), burst) == before + after));
      }
    }
  }
}

TEST_CASE(
    "any number of 0F that are no headers cost at most two frames on a line without gaps, and none where gaps are") {
  const Frames all = neutralFrames(16);
  const Frames before(all.begin(), all.begin() + 2);
  const Frames after(all.begin() + 2, all.end());
  for (size_t headers = 1; headers <= 150; headers++) {
    CAPTURE(headers);
    for (const size_t burst : {1u, 16u, 64u}) {
      for (const bool byEvents : {false, true}) {
        INFO("burst ", burst, ", byEvents ", byEvents);
        const Frames found = feedNew(join(before) + Bytes(headers, 0x0F) + join(after), burst, byEvents);
        CHECK(isPartOf(found, all));
        CHECK(found.size() >= all.size() - 2);
      }
    }
    TimedLine line;
    line.send(all[0]).gap(GapUs).send(all[1]).gap(GapUs).send(Bytes(headers, 0x0F)).gap(GapUs);
    line.send(all[2]).gap(GapUs).send(all[3]);
    for (const uint32_t loopUs : {50u, 1000u}) {
      CAPTURE(loopUs);
      CHECK(line.frames(loopUs) == Frames(all.begin(), all.begin() + 4));
    }
  }
}

TEST_CASE(
    "silence within a frame rejects it; a loop() that is blocked there costs nothing, or the frame if it polls by "
    "events") {
  for (size_t cut = 1; cut < 25; cut++) {
    for (const bool neutral : {false, true}) {
      INFO("cut ", cut, ", neutral ", neutral);
      const Frame frame = neutral ? Neutral.bytes : PaperLow.bytes;
      for (const size_t burst : {1u, 25u}) {
        Feeder line;
        line.lock().feed(part(frame, 0, cut));
        CHECK(line.wait(8000).feed(part(frame, cut), burst).empty());
        CHECK(line.wait(GapUs).feed(bytesOf(PaperHigh.bytes)) == Frames{PaperHigh.bytes});
      }
      for (const uint32_t blockedUs : {8000u, 10000000u}) {
        CAPTURE(blockedUs);
        Feeder line;
        line.lock().feed(part(frame, 0, cut));
        CHECK(line.block(blockedUs).poll(part(frame, cut)) == Frames{frame});
      }
      // A late call may mean a gap or a blocked loop(). It is taken for a gap, unless more bytes wait than a port hands
      // over at once.
      Feeder events;
      for (unsigned number = 0; number < 3; number++) {
        events.block(GapUs).feed(bytesOf(plainFrame(number)));
      }
      events.block(GapUs).feed(part(frame, 0, cut));
      CHECK(events.block(8000).poll(part(frame, cut)) == (25 - cut > 17 ? Frames{frame} : Frames{}));
      CHECK(events.block(GapUs).feed(bytesOf(PaperHigh.bytes)) == Frames{PaperHigh.bytes});
    }
  }
}
