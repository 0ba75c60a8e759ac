// What pack() writes, and that it is the exact inverse of unpack().
#include "sbus/Frame.h"

#include <doctest/doctest.h>
#include <rapidcheck.h>

#include "support/KnownFrames.h"
#include "support/ShowArrays.h"

namespace {

Frame packed(const Channels &channels, bool failsafe = false, bool lostFrame = false) {
  Frame frame;
  frame.fill(0xFF);
  sbus::pack(frame.data(), channels.data(), failsafe, lostFrame);
  return frame;
}

// 0..2047 for CH1..CH16, 0 or 1 for CH17 and CH18.
Channels anyChannels() {
  Channels channels;
  for (unsigned i = 0; i < channels.size(); i++) {
    channels[i] = *rc::gen::inRange<uint16_t>(0, i < 16 ? 2048 : 2);
  }
  return channels;
}

}  // namespace

TEST_CASE("pack writes known frames to the byte") {
  for (const KnownFrame &known : {PaperLow, PaperHigh, Neutral}) {
    CAPTURE(known.source);
    CHECK(packed(known.channels) == known.bytes);
  }
}

TEST_CASE("pack ends a frame with 00, whatever end byte its channels came with") {
  Frame expected = Sbus2.bytes;
  expected[24] = 0x00;
  CHECK(packed(Sbus2.channels) == expected);
}

TEST_CASE("each channel bit goes into the payload bit that the bit-by-bit writing gives it") {
  for (unsigned bit = 0; bit < PayloadBits; bit++) {
    CAPTURE(bit);
    Channels channels{};
    channels[bit / 11] = static_cast<uint16_t>(1 << bit % 11);
    CHECK(packed(channels) == writeBitByBit(channels));
  }
}

TEST_CASE("CH17, CH18, lost frame and failsafe go into flags bits 0..3") {
  for (unsigned flags = 0; flags < 16; flags++) {
    CAPTURE(flags);
    Channels channels = PaperLow.channels;
    channels[16] = (flags & 1) != 0;
    channels[17] = (flags & 2) != 0;
    Frame expected = PaperLow.bytes;
    expected[23] = static_cast<uint8_t>(flags);
    CHECK(packed(channels, (flags & 8) != 0, (flags & 4) != 0) == expected);
  }
}

TEST_CASE("a channel above 2047 is sent as 2047 and spills into no neighbour") {
  const uint16_t tooHigh[] = {2048, 2049, 4095, 4096, 32768, 65535};
  for (const uint16_t value : tooHigh) {
    for (unsigned channel = 0; channel < 16; channel++) {
      CAPTURE(value);
      CAPTURE(channel);
      Channels channels{};
      channels[channel] = value;
      Channels limited{};
      limited[channel] = 2047;
      CHECK(packed(channels) == writeBitByBit(limited));
    }
  }
}

TEST_CASE("CH17 and CH18 are sent as 1 unless they are 0") {
  const uint16_t switchedOn[] = {1, 2, 255, 256, 32768, 65535};
  for (const uint16_t value : switchedOn) {
    CAPTURE(value);
    Channels channels{};
    channels[16] = value;
    CHECK(packed(channels)[23] == 0x01);
    channels[16] = 0;
    channels[17] = value;
    CHECK(packed(channels)[23] == 0x02);
  }
}

TEST_CASE("pack writes 25 bytes and not one more") {
  std::array<uint8_t, 27> guarded;
  guarded.fill(0xA5);
  Channels channels;
  channels.fill(65535);
  sbus::pack(guarded.data() + 1, channels.data(), true, true);
  CHECK(guarded.front() == 0xA5);
  CHECK(guarded[1] == 0x0F);
  CHECK(guarded[25] == 0x00);
  CHECK(guarded.back() == 0xA5);
}

TEST_CASE("channels survive packing and unpacking") {
  CHECK(rc::check("unpack(pack(channels)) == channels", [] {
    const Channels channels = anyChannels();
    const bool failsafe = *rc::gen::arbitrary<bool>();
    const bool lostFrame = *rc::gen::arbitrary<bool>();
    const Frame frame = packed(channels, failsafe, lostFrame);
    Channels again;
    sbus::unpack(frame.data(), again.data());
    RC_ASSERT(again == channels);
    RC_ASSERT(readBitByBit(frame) == channels);
    RC_ASSERT(sbus::failsafe(frame.data()) == failsafe);
    RC_ASSERT(sbus::lostFrame(frame.data()) == lostFrame);
    RC_ASSERT(sbus::isFrame(frame.data()));
  }));
}

TEST_CASE("frames survive unpacking and packing") {
  CHECK(rc::check("pack(unpack(frame)) == frame", [] {
    Frame frame = *rc::gen::arbitrary<Frame>();
    frame[0] = 0x0F;
    frame[23] &= 0x0F;
    frame[24] = 0x00;
    Channels channels;
    sbus::unpack(frame.data(), channels.data());
    RC_ASSERT(channels == readBitByBit(frame));
    RC_ASSERT(packed(channels, sbus::failsafe(frame.data()), sbus::lostFrame(frame.data())) == frame);
  }));
}
