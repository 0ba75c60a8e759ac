// The receiver on a damaged line: one damage costs one frame, and what is delivered was on the wire.
//
// Lines without any pause are harder than any wire: they are what a loop() that was blocked reads.
#include "sbus/Receiver.h"

#include <doctest/doctest.h>
#include <rapidcheck.h>

#include "Feed.h"
#include "KnownFrames.h"
#include "ShowArrays.h"

namespace {

const Frames Two = {Neutral.bytes, PaperHigh.bytes};

constexpr unsigned LineFrames = 8;  // of the lines below; frame Damaged is the one with a byte too few or too many
constexpr unsigned Damaged = 3;
constexpr uint32_t PauseUs = 4000;  // T = 7 ms

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

bool holds(const Bytes &bytes, const Frame &frame) {
  return std::search(bytes.begin(), bytes.end(), frame.begin(), frame.end()) != bytes.end();
}

// What a line of neutralFrames() gives, `burst` coming instead of one of them, in lumps and with pauses or without.
Frames withBurst(const Bytes &burst, size_t lump, uint32_t pauseUs) {
  Feeder feeder;
  Frames found;
  const auto add = [&found](const Frames &frames) { found.insert(found.end(), frames.begin(), frames.end()); };
  Bytes solid;
  for (unsigned number = 0; number < LineFrames; number++) {
    const Bytes bytes = number == Damaged ? burst : bytesOf(neutralFrame(number));
    if (pauseUs != 0) {
      add(feeder.feed(bytes, lump));
      feeder.wait(pauseUs);
    } else {
      solid = solid + bytes;
    }
  }
  add(feeder.feed(solid, lump));
  add(feeder.idle());
  return found;
}

// And through the board's driver.
Frames withBurstOnBoard(const Bytes &burst, uint32_t loopUs, uint64_t pauseUs) {
  Wire wire;
  for (unsigned number = 0; number < LineFrames; number++) {
    wire.send(number == Damaged ? burst : bytesOf(neutralFrame(number))).pause(pauseUs);
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
  const Bytes rows[] = {
      {0x00},
      {0xA5, 0x5A, 0xFF},
      Bytes(100, 0xFF),
      {0x0F},
      {0x0F, 0x0F, 0x0F},
      {0xA5, 0x0F, 0xA5},
      Bytes(30, 0x0F),
  };
  for (const Bytes &garbage : rows) {
    CAPTURE(garbage.size());
    CHECK(feedNew(garbage + join(Two)) == Two);
    CHECK(feedNew(garbage + join(Two), 64) == Two);
  }
}

TEST_CASE("joining the line in the middle of a frame costs that frame only") {
  for (const size_t lump : {1u, 16u, 64u}) {
    for (size_t missing = 1; missing < 25; missing++) {
      CAPTURE(lump);
      CAPTURE(missing);
      CHECK(feedNew(part(Neutral.bytes, missing) + join(Two), lump) == Two);
    }
  }
}

TEST_CASE("joining neutral sticks on the board, at any offset, costs one frame, and the next is there before its end") {
  for (const uint32_t loopUs : {50u, 1000u, 3000u}) {
    for (const uint64_t pauseUs : {1000u, 4000u, 11000u}) {
      for (size_t missing = 1; missing < 25; missing++) {
        CAPTURE(loopUs);
        CAPTURE(pauseUs);
        CAPTURE(missing);
        Wire wire;
        wire.send(part(neutralFrame(0), missing)).pause(pauseUs);
        for (unsigned number = 1; number < 4; number++) {
          wire.send(neutralFrame(number)).pause(pauseUs);
        }
        CHECK(wire.frames(loopUs) == Frames{neutralFrame(1), neutralFrame(2), neutralFrame(3)});
      }
    }
  }
}

TEST_CASE("a receiver that has taken payloads for frames finds the true ones, though it sees no pause") {
  constexpr unsigned Sent = 200;
  for (const uint32_t period : {4000u, 6000u}) {
    for (size_t place = 3; place < 22; place++) {  // from here to the same place of the next, it looks like a frame
      Wire wire;
      Frames sent;
      for (unsigned number = 0; number < Sent; number++) {
        Frame frame = withByte(plainFrame(number), place - 2, 0);
        frame[place - 1] = 0;
        frame[place] = 0x0F;
        sent.push_back(frame);
        wire.send(number == 0 ? part(frame, place) : bytesOf(frame)).pause(period - 3000);
      }
      const Frames found = wire.frames(3000);
      CAPTURE(period);
      CAPTURE(place);
      REQUIRE(found.size() >= Sent / 2);
      CHECK(Frames(found.end() - Sent / 2, found.end()) == Frames(sent.end() - Sent / 2, sent.end()));
    }
  }
}

TEST_CASE("a byte lost at any place of a neutral frame costs that frame and no other, with pauses between the frames") {
  const Frames expected = allBut(neutralFrames(), Damaged);
  for (size_t index = 0; index < 25; index++) {
    CAPTURE(index);
    const Bytes burst = without(neutralFrame(Damaged), index);
    for (const size_t lump : {1u, 5u, 16u, 25u, 64u}) {
      CAPTURE(lump);
      CHECK(withBurst(burst, lump, PauseUs) == expected);
    }
    for (const uint32_t loopUs : {50u, 1000u, 3000u}) {
      CAPTURE(loopUs);
      CHECK(withBurstOnBoard(burst, loopUs, PauseUs) == expected);
    }
  }
}

TEST_CASE("a byte lost at any place of a neutral frame costs that frame and no other, without any pause") {
  const Frames expected = allBut(neutralFrames(), Damaged);
  for (size_t index = 0; index < 25; index++) {
    const Bytes burst = without(neutralFrame(Damaged), index);
    for (const size_t lump : {1u, 5u, 16u, 25u, 64u}) {
      CAPTURE(index);
      CAPTURE(lump);
      const Frames found = withBurst(burst, lump, 0);
      // The frame before the lost header is followed by 24 bytes at once: to a fast loop() it is the beginning of a
      // longer frame. There is no such wire.
      const bool looksLonger = index == 0 && lump == 16;
      CHECK(found == (looksLonger ? allBut(expected, Damaged - 1) : expected));
    }
  }
}

TEST_CASE("any byte inserted at any place of a neutral frame costs at most that frame, with pauses, and none is wrong") {
  const Frames all = neutralFrames();
  const Frames expected = allBut(all, Damaged);
  for (size_t index = 0; index < 25; index++) {
    for (unsigned byte = 0; byte < 256; byte++) {
      CAPTURE(index);
      CAPTURE(byte);
      const Bytes burst = with(neutralFrame(Damaged), index, static_cast<uint8_t>(byte));
      const bool mayCome = holds(burst, all[Damaged]);
      for (const size_t lump : {16u, 64u}) {
        CAPTURE(lump);
        const Frames found = withBurst(burst, lump, PauseUs);
        CHECK((found == expected || (mayCome && found == all)));
      }
      for (const uint32_t loopUs : {50u, 3000u}) {
        CAPTURE(loopUs);
        const Frames found = withBurstOnBoard(burst, loopUs, PauseUs);
        CHECK((found == expected || (mayCome && found == all)));
      }
    }
  }
}

TEST_CASE("any byte inserted at any place of a neutral frame, without any pause, costs one frame and none is wrong") {
  const Frames all = neutralFrames();
  for (size_t index = 0; index < 25; index++) {
    for (unsigned byte = 0; byte < 256; byte++) {
      CAPTURE(index);
      CAPTURE(byte);
      const Bytes burst = with(neutralFrame(Damaged), index, static_cast<uint8_t>(byte));
      const bool mayCome = holds(burst, all[Damaged]);
      for (const size_t lump : {16u, 64u}) {
        CAPTURE(lump);
        const Frames found = withBurst(burst, lump, 0);
        // A byte in front of the header may as well have been behind the end of the frame before.
        const bool before = index == 0 && found == allBut(all, Damaged - 1);
        CHECK((found == allBut(all, Damaged) || (mayCome && found == all) || before));
      }
    }
  }
}

TEST_CASE("a port that hands over byte by byte: an inserted byte can change the flags, but never a channel") {
  const Frames all = neutralFrames();
  for (size_t index = 0; index < 25; index++) {
    for (unsigned byte = 0; byte < 256; byte++) {
      CAPTURE(index);
      CAPTURE(byte);
      Frames found = withBurst(with(neutralFrame(Damaged), index, static_cast<uint8_t>(byte)), 1, PauseUs);
      const bool atFlags = index == 23 && byte < 0x10;
      for (Frame &frame : found) {
        frame[23] = atFlags ? 0 : frame[23];
      }
      CHECK((found == allBut(all, Damaged) || (found == all && (atFlags || index == 0 || index == 24))));
    }
  }
}

TEST_CASE("a frame with a 0F too many inside the payload is not delivered and costs no other frame") {
  for (size_t index = 2; index <= 22; index++) {
    CAPTURE(index);
    CHECK(feedNew(with(PaperLow.bytes, index, 0x0F) + join(Two)) == Two);
  }
}

TEST_CASE("only frames with one of the six end bytes are delivered, and the next frame always is") {
  for (unsigned byte = 0; byte < 256; byte++) {
    CAPTURE(byte);
    const bool right = byte == 0x00 || byte == 0x04 || byte == 0x08 || byte == 0x14 || byte == 0x24 || byte == 0x34;
    const Frame frame = withByte(PaperLow.bytes, 24, byte);
    CHECK(feedNew(join({frame, PaperHigh.bytes})) ==
          (right ? Frames{frame, PaperHigh.bytes} : Frames{PaperHigh.bytes}));
  }
}

TEST_CASE("only frames with unused flags bits 0 are delivered, and the next frame always is") {
  for (unsigned byte = 0; byte < 256; byte++) {
    CAPTURE(byte);
    const Frame frame = withByte(PaperLow.bytes, 23, byte);
    CHECK(feedNew(join({frame, PaperHigh.bytes})) ==
          (byte < 16 ? Frames{frame, PaperHigh.bytes} : Frames{PaperHigh.bytes}));
  }
}

TEST_CASE("of a refused frame nothing reaches the last complete one") {
  Feeder feeder;
  feeder.feed(bytesOf(PaperHigh.bytes));
  feeder.feed(bytesOf(withByte(PaperLow.bytes, 24, 0xFF)));
  CHECK(lastFrame(feeder.receiver) == PaperHigh.bytes);
}

TEST_CASE("any number of 0F that are no headers cost at most six frames that follow them without a pause") {
  Frames all;
  for (unsigned number = 0; number < 16; number++) {
    all.push_back(neutralFrame(number));
  }
  const Frames before(all.begin(), all.begin() + 2);
  for (size_t candidates = 1; candidates <= 150; candidates++) {
    for (const size_t lump : {1u, 16u, 64u}) {
      CAPTURE(candidates);
      CAPTURE(lump);
      const Frames found =
          feedNew(join(before) + Bytes(candidates, 0x0F) + join(Frames(all.begin() + 2, all.end())), lump);
      CHECK(std::includes(all.begin(), all.end(), found.begin(), found.end()));
      CHECK(found.size() >= all.size() - 6);
    }
  }
}

TEST_CASE("any number of 0F that are no headers cost no frame that follows them behind a pause") {
  const Frames all = {PaperHigh.bytes, PaperLow.bytes, Neutral.bytes, PaperHigh.bytes};
  for (size_t candidates = 1; candidates <= 120; candidates++) {
    for (const uint32_t loopUs : {50u, 1000u}) {
      CAPTURE(candidates);
      CAPTURE(loopUs);
      Wire wire;
      wire.send(all[0]).pause(PauseUs).send(all[1]).pause(PauseUs).send(Bytes(candidates, 0x0F)).pause(PauseUs);
      CHECK(wire.send(all[2]).pause(PauseUs).send(all[3]).frames(loopUs) == all);
    }
  }
}

// Fewer than 17 bytes behind the break come in one lump, as they do behind a loop() that was blocked: that is a frame.
TEST_CASE("a wire that breaks within a frame and is whole again at the same place of the next makes no frame of the two") {
  for (const uint32_t loopUs : {50u, 1000u}) {
    for (size_t cut = 1; cut <= 25 - 17; cut++) {
      CAPTURE(loopUs);
      CAPTURE(cut);
      Wire wire;
      wire.send(PaperLow.bytes).pause(PauseUs).send(PaperLow.bytes).pause(PauseUs);
      wire.send(part(PaperLow.bytes, 0, cut)).pause(25 * 120 + PauseUs).send(part(Neutral.bytes, cut)).pause(PauseUs);
      wire.send(PaperHigh.bytes).pause(PauseUs).send(PaperHigh.bytes);
      for (const Frame &frame : wire.frames(loopUs)) {
        CHECK((frame == PaperLow.bytes || frame == Neutral.bytes || frame == PaperHigh.bytes));
      }
    }
  }
}

TEST_CASE("whatever comes, only pieces of it that are frames are delivered, in order and without overlap") {
  CHECK(rc::check("delivered frames stand in the stream", [] {
    const Bytes bytes = anyBytes() + bytesOf(PaperLow.bytes) + anyBytes() + bytesOf(PaperHigh.bytes) + anyBytes();
    const auto lump = *rc::gen::inRange<size_t>(1, 70);
    auto from = bytes.begin();
    for (const Frame &frame : feedNew(bytes, lump)) {
      RC_ASSERT(sbus::isFrame(frame.data()));
      const auto found = std::search(from, bytes.end(), frame.begin(), frame.end());
      RC_ASSERT(found != bytes.end());
      from = found + 25;
    }
  }));
}

TEST_CASE("any frames that one receiver sends without damage are delivered, all and in order") {
  CHECK(rc::check("clean stream in == frames out", [] {
    const auto kind = *rc::gen::element<unsigned>(0x00, 0x04, 0x08);
    Frames frames = *rc::gen::container<Frames>(rc::gen::arbitrary<Frame>());
    Bytes bytes;
    for (Frame &frame : frames) {
      frame[0] = 0x0F;
      frame[23] = static_cast<uint8_t>(frame[23] & 0x0F) == 0x0F ? 0 : frame[23] & 0x0F;  // 0F: MakesTest
      frame[24] = static_cast<uint8_t>(kind == 0x04 ? kind | (frame[24] & 0x30) : kind);
      bytes = bytes + bytesOf(frame) + (kind == 0x08 ? Bytes{0x00, 0x03, 0xC0, 0x33, 0x00} : Bytes{});
    }
    RC_ASSERT(feedNew(bytes, *rc::gen::inRange<size_t>(1, 70)) == frames);
  }));
}
