// Finding frames on a damaged line: one damage costs one frame, and what is delivered was on the line.
// The torture bench (test/line) shows the same of random damage.
#include "sbus/FrameFinder.h"

#include <doctest/doctest.h>

#include "support/Feed.h"
#include "support/ShowArrays.h"

namespace {

const Frames Two = {Neutral.bytes, PaperHigh.bytes};

constexpr unsigned LineFrames = 8;  // of the lines below; frame Damaged is the one that is damaged
constexpr unsigned Damaged = 3;
constexpr uint32_t PauseUs = Feeder::PauseUs;

Frames neutralFrames(unsigned count) {
  Frames frames;
  for (unsigned number = 0; number < count; number++) {
    frames.push_back(neutralFrame(number));
  }
  return frames;
}

Frames allBut(Frames frames, unsigned index) {
  frames.erase(frames.begin() + index);
  return frames;
}

// What a line of neutralFrames() gives, `bytes` coming instead of one of them, with pauses or without.
Frames withBytes(const Bytes &bytes, size_t burst, uint32_t pauseUs) {
  Feeder feeder;
  feeder.settle();
  Frames found;
  Bytes solid;
  for (unsigned number = 0; number < LineFrames; number++) {
    solid = solid + (number == Damaged ? bytes : bytesOf(neutralFrame(number)));
    if (pauseUs != 0 || number + 1 == LineFrames) {
      found = found + feeder.feed(solid, burst);
      feeder.wait(pauseUs);
      solid.clear();
    }
  }
  return found;
}

}  // namespace

TEST_CASE("garbage in front of the first frame costs no frame, neither does joining the line in the middle of one") {
  std::vector<Bytes> rows = {{0x00},       {0xA5, 0x5A, 0xFF}, Bytes(100, 0xFF), {0x0F}, {0x0F, 0x0F, 0x0F},
                             {0xA5, 0x0F, 0xA5}, Bytes(23, 0x0F)};
  for (size_t missing = 1; missing < 25; missing++) {
    rows.push_back(part(Neutral.bytes, missing));
  }
  for (const Bytes &garbage : rows) {
    for (const size_t burst : {1u, 16u, 64u}) {
      INFO("garbage.size() ", garbage.size(), ", burst ", burst);
      CHECK(feedNew(garbage + join(Two), burst) == Two);
    }
  }
}

TEST_CASE("a failsafe frame with a second reading, at every character after a break, without a pause: never the wrong one") {
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
      const Frames found = line.feed(bytes, burst);
      CHECK(found == Frames(found.size(), FailsafeFrame));
    }
  }
}

TEST_CASE("up to 12 bytes lost at any place of a neutral frame cost that frame and no other, and none is wrong") {
  const Frames expected = allBut(neutralFrames(LineFrames), Damaged);
  const Frame frame = neutralFrame(Damaged);
  for (size_t lost = 1; lost <= 12; lost++) {
    for (size_t index = 0; index + lost <= 25; index++) {
      INFO("lost ", lost, ", index ", index);
      const Bytes bytes = part(frame, 0, index) + part(frame, index + lost);
      CHECK(withBytes(bytes, 1, PauseUs) == expected);
      for (const size_t burst : {5u, 16u, 25u, 64u}) {
        CAPTURE(burst);
        CHECK((lost > 1 || withBytes(bytes, burst, PauseUs) == expected));
        // Without a pause the frame before the lost header has 24 characters after it: it may be part of a longer one.
        CHECK((lost > 1 || index == 0 || withBytes(bytes, burst, 0) == expected));
      }
      for (const uint32_t loopUs : {50u, 1000u, 3000u}) {
        CAPTURE(loopUs);
        TimedLine line;
        for (unsigned number = 0; number < LineFrames; number++) {
          line.send(number == Damaged ? bytes : bytesOf(neutralFrame(number))).pause(PauseUs);
        }
        CHECK(((lost > 1 && loopUs != 1000) || line.frames(loopUs) == expected));
      }
    }
  }
}

TEST_CASE("a frame with a 0F too many inside the payload is not delivered and costs no other frame") {
  for (size_t index = 2; index <= 22; index++) {
    CAPTURE(index);
    CHECK(feedNew(with(PaperLow.bytes, index, 0x0F) + join(Two)) == Two);
  }
}

TEST_CASE("of a refused frame nothing reaches the last complete one") {
  Feeder feeder;
  feeder.lock().feed(bytesOf(PaperHigh.bytes) + bytesOf(withByte(PaperLow.bytes, 24, 0xFF)));
  CHECK(lastFrame(feeder.finder) == PaperHigh.bytes);
}

TEST_CASE("any number of 0F that are no headers cost at most six frames after them without a pause, and none after one") {
  const Frames all = neutralFrames(16);
  const Frames before(all.begin(), all.begin() + 2);
  const Frames after(all.begin() + 2, all.end());
  for (size_t headers = 1; headers <= 150; headers++) {
    CAPTURE(headers);
    for (const size_t burst : {1u, 16u, 64u}) {
      CAPTURE(burst);
      const Frames found = feedNew(join(before) + Bytes(headers, 0x0F) + join(after), burst);
      CHECK(isPartOf(found, all));
      CHECK(found.size() >= all.size() - 6);
    }
    TimedLine line;
    line.send(all[0]).pause(PauseUs).send(all[1]).pause(PauseUs).send(Bytes(headers, 0x0F)).pause(PauseUs);
    line.send(all[2]).pause(PauseUs).send(all[3]);
    for (const uint32_t loopUs : {50u, 1000u}) {
      CAPTURE(loopUs);
      CHECK(line.frames(loopUs) == Frames(all.begin(), all.begin() + 4));
    }
  }
}

// Fewer than 17 bytes after the break come in one burst, as they do after a loop() that was blocked: that is a frame.
TEST_CASE("a wire that breaks within a frame and is whole again at the same place of the next makes no frame of the two") {
  const Frames right = {PaperLow.bytes, Neutral.bytes, PaperHigh.bytes};
  for (const uint32_t loopUs : {50u, 1000u}) {
    for (size_t cut = 1; cut <= 25 - 17; cut++) {
      INFO("loopUs ", loopUs, ", cut ", cut);
      TimedLine line;
      line.send(PaperLow.bytes).pause(PauseUs).send(PaperLow.bytes).pause(PauseUs);
      line.send(part(PaperLow.bytes, 0, cut)).pause(25 * 120 + PauseUs).send(part(Neutral.bytes, cut)).pause(PauseUs);
      line.send(PaperHigh.bytes).pause(PauseUs).send(PaperHigh.bytes);
      const Frames found = line.frames(loopUs);
      CHECK(found.size() >= 4);
      for (const Frame &frame : found) {
        CHECK(std::count(right.begin(), right.end(), frame) == 1);
      }
    }
  }
}

TEST_CASE("a pause before any byte of a frame refuses it, unless the others come in one burst, as to a loop() that blocked") {
  for (size_t cut = 1; cut < 25; cut++) {
    for (const bool neutral : {false, true}) {
      for (const bool atOnce : {false, true}) {
        INFO("cut ", cut, ", neutral ", neutral, ", atOnce ", atOnce);
        const Frame frame = neutral ? Neutral.bytes : PaperLow.bytes;
        Feeder line;
        line.lock().feed(part(frame, 0, cut));
        const Frames found = line.wait(8000).feed(part(frame, cut), atOnce ? 25 : 1);
        const bool delivered = atOnce && 25 - cut >= 5 && frame[cut] != sbus::HeaderByte;
        CHECK(found == (delivered ? Frames{frame} : Frames{}));
        CHECK(line.wait(PauseUs).feed(bytesOf(PaperHigh.bytes)) == Frames{PaperHigh.bytes});
      }
    }
  }
}
