// The receiver on a damaged line: one damage costs one frame, and what is delivered was on the wire.
#include "sbus/FrameFinder.h"

#include <doctest/doctest.h>
#include <rapidcheck.h>

#include "support/Feed.h"
#include "support/ShowArrays.h"

namespace {

const Frames Two = {Neutral.bytes, PaperHigh.bytes};

constexpr unsigned LineFrames = 8;  // of the lines below; frame Damaged is the one that is damaged
constexpr unsigned Damaged = 3;
constexpr uint32_t PauseUs = Feeder::PauseUs;

// A failsafe frame of a real receiver. It has a second reading, which begins with its flags, 0F, and ends before them.
constexpr Frame FailsafeFrame = {0x0F, 0xD8, 0x1B, 0x1F, 0x2B, 0xB2, 0xC7, 0x0A, 0x0F, 0x7C, 0x00, 0x00, 0x00,
                                 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x0F, 0x00};

Frames neutralFrames() {
  Frames frames;
  for (unsigned number = 0; number < LineFrames; number++) {
    frames.push_back(neutralFrame(number));
  }
  return frames;
}

Frames allBut(Frames frames, unsigned index) {
  frames.erase(frames.begin() + index);
  return frames;
}

// What a line of neutralFrames() gives, `burst` coming instead of one of them, with pauses or without.
Frames withBurst(const Bytes &bytes, size_t burst, uint32_t pauseUs) {
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

// And through the board's driver.
Frames withBurstOnBoard(const Bytes &bytes, uint32_t loopUs) {
  FedLine wire;
  for (unsigned number = 0; number < LineFrames; number++) {
    wire.send(number == Damaged ? bytes : bytesOf(neutralFrame(number))).pause(PauseUs);
  }
  return wire.frames(loopUs);
}

// Bytes as a bad line gives them: more than half of them mean something to a receiver.
Bytes anyBytes() {
  return *rc::gen::container<Bytes>(
      rc::gen::oneOf(rc::gen::element<uint8_t>(0x0F, 0x00, 0x04, 0x08, 0x7C), rc::gen::arbitrary<uint8_t>()));
}

}  // namespace

TEST_CASE("garbage in front of the first frame costs no frame") {
  const Bytes rows[] = {{0x00},       {0xA5, 0x5A, 0xFF}, Bytes(100, 0xFF), {0x0F}, {0x0F, 0x0F, 0x0F},
                        {0xA5, 0x0F, 0xA5}, Bytes(23, 0x0F)};
  for (const Bytes &garbage : rows) {
    CAPTURE(garbage.size());
    CHECK(feedNew(garbage + join(Two)) == Two);
    CHECK(feedNew(garbage + join(Two), 64) == Two);
  }
}

TEST_CASE("joining the line in the middle of a frame, without any pause, costs that frame only") {
  for (const size_t burst : {1u, 16u, 64u}) {
    for (size_t missing = 1; missing < 25; missing++) {
      CAPTURE(burst);
      CAPTURE(missing);
      CHECK(feedNew(part(Neutral.bytes, missing) + join(Two), burst) == Two);
    }
  }
}

TEST_CASE("joining neutral sticks on the board, at any offset, costs one frame, or one more if its pause is not seen") {
  for (const uint32_t loopUs : {50u, 1000u, 3000u}) {
    for (const uint64_t pauseUs : {1000u, 4000u, 11000u}) {
      for (size_t missing = 1; missing < 25; missing++) {
        CAPTURE(loopUs);
        CAPTURE(pauseUs);
        CAPTURE(missing);
        FedLine wire;
        wire.send(part(neutralFrame(0), missing)).pause(pauseUs);
        for (unsigned number = 1; number < 4; number++) {
          wire.send(neutralFrame(number)).pause(pauseUs);
        }
        const Frames found = wire.frames(loopUs);
        // 5 to 11 characters straight before a frame may be the beginning of one with 24 channels.
        const bool oneMore = loopUs > 50 && missing >= 25 - 11 && missing <= 25 - 5 && found.size() == 2;
        CHECK(Frames{neutralFrame(1), neutralFrame(2), neutralFrame(3)} ==
              (oneMore ? Frames{neutralFrame(1)} : Frames{}) + found);
      }
    }
  }
}

TEST_CASE("a failsafe frame with a second reading, joined at every character: never the wrong one, the true one if seen") {
  for (const uint32_t periodUs : {4000u, 5000u, 7000u, 9000u, 14000u}) {
    for (const uint32_t loopUs : {50u, 500u, 1000u, 2000u, 3000u, 5000u}) {
      for (size_t missing = 0; missing < 25; missing++) {
        CAPTURE(periodUs);
        CAPTURE(loopUs);
        CAPTURE(missing);
        constexpr unsigned Count = 40;
        FedLine wire;
        for (unsigned number = 0; number <= Count; number++) {
          wire.send(part(FailsafeFrame, number == 0 ? missing : 0)).pause(periodUs - 3000);
        }
        const Frames found = wire.joined(loopUs);
        CHECK(found == Frames(found.size(), FailsafeFrame));
        if (periodUs >= 7000 && loopUs <= 1000) {
          CHECK(found.size() >= Count - 1);
        }
      }
    }
  }
}

TEST_CASE("a failsafe frame with a second reading, at every character after a break, without a pause: never the wrong one") {
  for (const size_t burst : {1u, 16u, 25u}) {
    for (size_t missing = 0; missing < 25; missing++) {
      CAPTURE(burst);
      CAPTURE(missing);
      Feeder line;
      line.lock().feed(bytesOf(FailsafeFrame), burst);
      line.receiver.broken();
      Bytes bytes = part(FailsafeFrame, missing);
      for (unsigned number = 0; number < 20; number++) {
        bytes = bytes + bytesOf(FailsafeFrame);
      }
      const Frames found = line.feed(bytes, burst);
      CHECK(found == Frames(found.size(), FailsafeFrame));
    }
  }
}

TEST_CASE("a byte lost at any place of a neutral frame costs that frame and no other, with pauses or without") {
  const Frames expected = allBut(neutralFrames(), Damaged);
  for (size_t index = 0; index < 25; index++) {
    CAPTURE(index);
    const Bytes bytes = without(neutralFrame(Damaged), index);
    for (const size_t burst : {1u, 5u, 16u, 25u, 64u}) {
      CAPTURE(burst);
      CHECK(withBurst(bytes, burst, PauseUs) == expected);
      // Without a pause the frame before the lost header has 24 characters after it: it may be part of a longer one,
      // if they are there already. There is no such wire.
      const Frames found = withBurst(bytes, burst, 0);
      const bool maySeemLonger = index == 0 && burst > 1;
      CHECK((found == expected || (maySeemLonger && found == allBut(expected, Damaged - 1))));
    }
    for (const uint32_t loopUs : {50u, 1000u, 3000u}) {
      CAPTURE(loopUs);
      CHECK(withBurstOnBoard(bytes, loopUs) == expected);
    }
  }
}

TEST_CASE("up to 12 bytes lost, some altered before, at any place of a neutral frame: no other frame is lost, none wrong") {
  const Frames all = neutralFrames();
  for (size_t lost = 2; lost <= 12; lost++) {
    for (size_t index = 0; index + lost <= 25; index++) {
      CAPTURE(lost);
      CAPTURE(index);
      const Bytes bytes = part(all[Damaged], 0, index) + part(all[Damaged], index + lost);
      CHECK(withBurst(bytes, 1, PauseUs) == allBut(all, Damaged));
      CHECK(withBurstOnBoard(bytes, 1000) == allBut(all, Damaged));
    }
  }
}

TEST_CASE("any byte in a pause, at any place of it, costs at most one of the frames beside it, and none is wrong") {
  const Frames all = neutralFrames();
  for (const uint32_t afterUs : {240u, 1000u, 2000u, 3000u, 3760u}) {
    for (unsigned byte = 0; byte < 256; byte++) {
      CAPTURE(afterUs);
      CAPTURE(byte);
      FedLine wire;
      for (const Frame &frame : all) {
        const bool noisy = frame == all[Damaged];
        wire.send(frame).pause(noisy ? afterUs : PauseUs);
        if (noisy) {
          wire.send(Bytes{static_cast<uint8_t>(byte)}).pause(PauseUs - afterUs - 120);
        }
      }
      for (const uint32_t loopUs : {50u, 1000u, 3000u}) {
        CAPTURE(loopUs);
        const Frames found = wire.frames(loopUs);
        CHECK((found == all || found == allBut(all, Damaged) || found == allBut(all, Damaged + 1)));
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
  CHECK(lastFrame(feeder.receiver) == PaperHigh.bytes);
}

TEST_CASE("any number of 0F that are no headers cost at most six frames after them without a pause, and none after one") {
  Frames all;
  for (unsigned number = 0; number < 16; number++) {
    all.push_back(neutralFrame(number));
  }
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
    FedLine wire;
    wire.send(all[0]).pause(PauseUs).send(all[1]).pause(PauseUs).send(Bytes(headers, 0x0F)).pause(PauseUs);
    wire.send(all[2]).pause(PauseUs).send(all[3]);
    for (const uint32_t loopUs : {50u, 1000u}) {
      CAPTURE(loopUs);
      CHECK(wire.frames(loopUs) == Frames(all.begin(), all.begin() + 4));
    }
  }
}

// Fewer than 17 bytes after the break come in one burst, as they do after a loop() that was blocked: that is a frame.
TEST_CASE("a wire that breaks within a frame and is whole again at the same place of the next makes no frame of the two") {
  const Frames right = {PaperLow.bytes, Neutral.bytes, PaperHigh.bytes};
  for (const uint32_t loopUs : {50u, 1000u}) {
    for (size_t cut = 1; cut <= 25 - 17; cut++) {
      CAPTURE(loopUs);
      CAPTURE(cut);
      FedLine wire;
      wire.send(PaperLow.bytes).pause(PauseUs).send(PaperLow.bytes).pause(PauseUs);
      wire.send(part(PaperLow.bytes, 0, cut)).pause(25 * 120 + PauseUs).send(part(Neutral.bytes, cut)).pause(PauseUs);
      wire.send(PaperHigh.bytes).pause(PauseUs).send(PaperHigh.bytes);
      const Frames found = wire.frames(loopUs);
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
        CAPTURE(cut);
        CAPTURE(neutral);
        CAPTURE(atOnce);
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

TEST_CASE("whatever comes, only pieces of it that are frames are delivered, in order and without overlap") {
  CHECK(rc::check("delivered frames stand in the stream", [] {
    const Bytes bytes = anyBytes() + bytesOf(PaperLow.bytes) + anyBytes() + bytesOf(PaperHigh.bytes) + anyBytes();
    const auto burst = *rc::gen::inRange<size_t>(1, 70);
    auto from = bytes.begin();
    for (const Frame &frame : feedNew(bytes, burst)) {
      RC_ASSERT(sbus::isFrame(frame.data()));
      const auto found = std::search(from, bytes.end(), frame.begin(), frame.end());
      RC_ASSERT(found != bytes.end());
      from = found + 25;
    }
  }));
}

TEST_CASE("any frames that one receiver sends without damage are delivered, all and in order, at once") {
  CHECK(rc::check("clean stream in == frames out", [] {
    const auto kind = *rc::gen::element<uint8_t>(0x00, 0x04, 0x08);
    Frames frames = *rc::gen::container<Frames>(rc::gen::arbitrary<Frame>());
    Bytes bytes;
    for (Frame &frame : frames) {
      frame[0] = 0x0F;
      frame[23] = frame[23] & 0x0F;
      frame[24] = static_cast<uint8_t>(kind == 0x04 ? kind | (frame[24] & 0x30) : kind);
      bytes = bytes + bytesOf(frame) + (kind == R7003End ? R7003Tail : Bytes{});
    }
    Feeder line;
    RC_ASSERT(line.lock(kind).feed(bytes, *rc::gen::inRange<size_t>(1, 70)) == frames);
  }));
}
