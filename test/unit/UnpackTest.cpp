// What unpack() and the flags read out of a frame.
#include "sbus/Frame.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "support/KnownFrames.h"
#include "support/ShowArrays.h"

namespace {

// By both ways of unpacking, which have to agree.
Channels unpacked(const Frame &frame) {
  Channels channels;
  sbus::unpack(frame.data(), channels.data());
  alignas(4) uint8_t padded[3 + 25];
  std::copy(frame.begin(), frame.end(), padded + 3);
  Channels aligned;
  sbus::unpackAligned(padded + 3, aligned.data());
  if (aligned != channels) {
    FAIL("unpack() and unpackAligned() differ");
  }
  return channels;
}

Channels allAt(uint16_t value) {
  Channels channels{};
  std::fill_n(channels.begin(), 16, value);
  return channels;
}

}  // namespace

TEST_CASE("the bit-by-bit reading gives the known channels of known frames") {
  for (const KnownFrame &known : KnownFrames) {
    CAPTURE(known.source);
    CHECK(readBitByBit(known.bytes) == known.channels);
  }
}

TEST_CASE("unpack gives the known channels of known frames") {
  for (const KnownFrame &known : KnownFrames) {
    CAPTURE(known.source);
    CHECK(unpacked(known.bytes) == known.channels);
    CHECK_FALSE(sbus::lostFrame(known.bytes.data()));
    CHECK_FALSE(sbus::failsafe(known.bytes.data()));
  }
}

TEST_CASE("every channel takes every value 0..2047 and leaves its neighbours alone") {
  for (const uint16_t others : {uint16_t{0}, uint16_t{2047}}) {
    for (unsigned channel = 0; channel < 16; channel++) {
      for (uint16_t value = 0; value <= 2047; value++) {
        Channels channels = allAt(others);
        channels[channel] = value;
        if (unpacked(writeBitByBit(channels)) != channels) {
          FAIL("channel ", channel + 1, ", value ", value, ", all others ", others);
        }
      }
    }
  }
}

TEST_CASE("each of the 176 payload bits is one bit of one channel") {
  for (unsigned bit = 0; bit < PayloadBits; bit++) {
    CAPTURE(bit);
    Frame frame{};
    setBit(frame, bit, true);
    Channels expected{};
    expected[bit / 11] = static_cast<uint16_t>(1 << bit % 11);
    CHECK(unpacked(frame) == expected);
  }
}

TEST_CASE("the lower flags bits are CH17, CH18, lost frame and failsafe, in this order") {
  for (unsigned flags = 0; flags < 16; flags++) {
    CAPTURE(flags);
    Frame frame = PaperLow.bytes;
    frame[23] = static_cast<uint8_t>(flags);
    Channels expected = PaperLow.channels;
    expected[16] = (flags & 1) != 0;
    expected[17] = (flags & 2) != 0;
    CHECK(unpacked(frame) == expected);
    CHECK(sbus::lostFrame(frame.data()) == ((flags & 4) != 0));
    CHECK(sbus::failsafe(frame.data()) == ((flags & 8) != 0));
  }
}

TEST_CASE("unpack looks neither at the header nor at the end byte") {
  Frame frame = PaperHigh.bytes;
  frame[0] = 0xFF;
  frame[24] = 0xFF;
  CHECK(unpacked(frame) == PaperHigh.channels);
}

TEST_CASE("unpack writes 18 values and not one more") {
  std::array<uint16_t, 20> guarded;
  guarded.fill(0xABCD);
  sbus::unpack(PaperLow.bytes.data(), guarded.data() + 1);
  CHECK(guarded.front() == 0xABCD);
  CHECK(guarded[18] == 0);
  CHECK(guarded.back() == 0xABCD);
}

TEST_CASE("unpackAligned writes 18 values and not one more") {
  alignas(4) uint8_t padded[3 + 25];
  std::copy(PaperLow.bytes.begin(), PaperLow.bytes.end(), padded + 3);
  std::array<uint16_t, 20> guarded;
  guarded.fill(0xABCD);
  sbus::unpackAligned(padded + 3, guarded.data() + 1);
  CHECK(guarded.front() == 0xABCD);
  CHECK(guarded[18] == 0);
  CHECK(guarded.back() == 0xABCD);
}
