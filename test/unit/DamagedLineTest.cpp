// The receiver on a damaged line: what is refused, and that one damage costs one frame.
//
// Every expectation holds for any good way of finding frames: the frames are such that no other 25 bytes look like one.
#include "sbus/Receiver.h"

#include <doctest/doctest.h>
#include <rapidcheck.h>

#include "Feed.h"
#include "KnownFrames.h"
#include "ShowArrays.h"

namespace {

const Frames Two = {Neutral.bytes, PaperHigh.bytes};

Bytes bytesOf(const Frame &frame) {
  return Bytes(frame.begin(), frame.end());
}

Bytes without(const Frame &frame, unsigned index) {
  Bytes bytes = bytesOf(frame);
  bytes.erase(bytes.begin() + index);
  return bytes;
}

Bytes with(const Frame &frame, unsigned index, uint8_t inserted) {
  Bytes bytes = bytesOf(frame);
  bytes.insert(bytes.begin() + index, inserted);
  return bytes;
}

Frame withByte(Frame frame, unsigned index, unsigned byte) {
  frame[index] = static_cast<uint8_t>(byte);
  return frame;
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
  for (unsigned missing = 1; missing < 25; missing++) {
    CAPTURE(missing);
    const Bytes rest(Neutral.bytes.begin() + missing, Neutral.bytes.end());
    CHECK(feedNew(rest + join(Two)) == Two);
  }
}

TEST_CASE("a frame that lost one byte is not delivered and costs no other frame") {
  for (const Frame &damaged : {PaperLow.bytes, Neutral.bytes}) {
    for (unsigned index = 0; index < 25; index++) {
      CAPTURE(index);
      CHECK(feedNew(bytesOf(Neutral.bytes) + without(damaged, index) + join(Two)) ==
            Frames{Neutral.bytes, Neutral.bytes, PaperHigh.bytes});
    }
  }
}

TEST_CASE("a frame with one byte too many is not delivered and costs no other frame") {
  for (const unsigned inserted : {0xA5u, 0xFFu}) {
    for (unsigned index = 1; index < 25; index++) {
      CAPTURE(inserted);
      CAPTURE(index);
      CHECK(feedNew(with(PaperLow.bytes, index, static_cast<uint8_t>(inserted)) + join(Two)) == Two);
    }
  }
}

TEST_CASE("a 0F too many inside the payload is not delivered and costs no other frame") {
  for (unsigned index = 2; index <= 22; index++) {
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

TEST_CASE("what real receivers send behind a frame is no frame and costs none") {
  const struct {
    const char *source;
    Bytes behind;
  } rows[] = {
      {"S.BUS2 telemetry, PX4-Autopilot sbus2_r7008SB.txt", {0x03, 0xC0, 0x2E}},
      {"S.BUS2 telemetry, PX4-Autopilot sbus2_r7008SB.txt", {0x03, 0xC4, 0x00}},
      {"Futaba R7003SB", {0x00, 0x03, 0xC0, 0x33, 0x00}},
  };
  for (const auto &row : rows) {
    CAPTURE(row.source);
    CHECK(feedNew(bytesOf(Neutral.bytes) + row.behind + bytesOf(PaperLow.bytes) + row.behind + join(Two)) ==
          Frames{Neutral.bytes, PaperLow.bytes, Neutral.bytes, PaperHigh.bytes});
  }
}

TEST_CASE("a frame with header 2F, FASSTest 26's further channels, is not delivered") {
  const Frame further = withByte(PaperLow.bytes, 0, 0x2F);
  CHECK(feedNew(join({further, PaperHigh.bytes, further, Neutral.bytes})) == Frames{PaperHigh.bytes, Neutral.bytes});
}

TEST_CASE("of a refused frame nothing reaches the last complete one") {
  sbus::Receiver receiver;
  feed(receiver, bytesOf(PaperHigh.bytes));
  feed(receiver, bytesOf(withByte(PaperLow.bytes, 24, 0xFF)));
  CHECK(lastFrame(receiver) == PaperHigh.bytes);
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

TEST_CASE("whatever comes, the cuts between lumps make no difference") {
  CHECK(rc::check("lumps == one byte at a time", [] {
    const Bytes bytes = anyBytes() + bytesOf(PaperLow.bytes) + anyBytes() + bytesOf(PaperHigh.bytes);
    RC_ASSERT(feedNew(bytes, *rc::gen::inRange<size_t>(2, 70)) == feedNew(bytes));
  }));
}

TEST_CASE("any frames sent without damage are delivered, all and in order") {
  CHECK(rc::check("clean stream in == frames out", [] {
    Frames frames = *rc::gen::container<Frames>(rc::gen::arbitrary<Frame>());
    const uint8_t endBytes[] = {0x00, 0x04, 0x08, 0x14, 0x24, 0x34};
    for (Frame &frame : frames) {
      frame[0] = 0x0F;
      frame[23] &= 0x0F;
      frame[24] = endBytes[frame[24] % 6];
    }
    RC_ASSERT(feedNew(join(frames), *rc::gen::inRange<size_t>(1, 70)) == frames);
  }));
}
