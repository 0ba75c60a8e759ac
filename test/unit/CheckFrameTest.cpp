// What isEndByte(), isFlagsByte() and isFrame() accept, over all bytes.
#include "sbus/Frame.h"

#include <doctest/doctest.h>

#include <set>

#include "support/KnownFrames.h"

// The checks can be made by the compiler, too.
static_assert(sbus::isFrame(PaperLow.bytes.data()), "the paper's frame is a frame");
static_assert(!sbus::isEndByte(0x0F), "a header ends no frame");

namespace {

// Futaba S.BUS and FrSky; S.BUS2's four telemetry slots; R7003SB and FASSTest 12CH.
const std::set<unsigned> EndBytes = {0x00, 0x04, 0x08, 0x14, 0x24, 0x34};

}  // namespace

TEST_CASE("of the 256 bytes six end a frame: 00 04 08 14 24 34") {
  for (unsigned byte = 0; byte < 256; byte++) {
    CAPTURE(byte);
    CHECK(sbus::isEndByte(static_cast<uint8_t>(byte)) == (EndBytes.count(byte) == 1));
  }
}

TEST_CASE("of the 256 bytes 00..0F can be flags, bits 4..7 being unused") {
  for (unsigned byte = 0; byte < 256; byte++) {
    CAPTURE(byte);
    CHECK(sbus::isFlagsByte(static_cast<uint8_t>(byte)) == (byte <= 0x0F));
  }
}

TEST_CASE("known frames are frames") {
  for (const KnownFrame &known : KnownFrames) {
    CAPTURE(known.source);
    CHECK(sbus::isFrame(known.bytes.data()));
  }
}

TEST_CASE("a frame begins with 0F and nothing else") {
  for (unsigned byte = 0; byte < 256; byte++) {
    CAPTURE(byte);
    Frame frame = PaperLow.bytes;
    frame[0] = static_cast<uint8_t>(byte);
    CHECK(sbus::isFrame(frame.data()) == (byte == 0x0F));
  }
}

TEST_CASE("a frame's byte 23 must be a flags byte") {
  for (unsigned byte = 0; byte < 256; byte++) {
    CAPTURE(byte);
    Frame frame = PaperLow.bytes;
    frame[23] = static_cast<uint8_t>(byte);
    CHECK(sbus::isFrame(frame.data()) == (byte <= 0x0F));
  }
}

TEST_CASE("a frame's byte 24 must be an end byte") {
  for (unsigned byte = 0; byte < 256; byte++) {
    CAPTURE(byte);
    Frame frame = PaperLow.bytes;
    frame[24] = static_cast<uint8_t>(byte);
    CHECK(sbus::isFrame(frame.data()) == (EndBytes.count(byte) == 1));
  }
}

TEST_CASE("no payload byte makes a frame or spoils it") {
  for (unsigned index = 1; index <= 22; index++) {
    for (unsigned byte = 0; byte < 256; byte++) {
      CAPTURE(index);
      CAPTURE(byte);
      Frame frame = PaperLow.bytes;
      frame[index] = static_cast<uint8_t>(byte);
      CHECK(sbus::isFrame(frame.data()));
      frame[24] = 0x01;
      CHECK_FALSE(sbus::isFrame(frame.data()));
    }
  }
}
