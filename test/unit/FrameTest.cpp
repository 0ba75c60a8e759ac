// The frame: which bytes are one, what they mean, and that pack() writes what unpack() reads.
#include <doctest/doctest.h>

#include <algorithm>

#include "sbus/Frame.h"
#include "support/Bytes.h"
#include "support/KnownFrames.h"
#include "support/ShowArrays.h"

// The checks also work at compile time.
static_assert(sbus::isFrame(PaperLow.bytes.data()), "the paper's frame is a frame");
static_assert(!sbus::isEndByte(0x0F), "a header ends no frame");

namespace {

// Futaba S.BUS and FrSky; S.BUS2's four telemetry slots; R7003SB and FASSTest 12CH.
constexpr unsigned EndBytes[] = {0x00, 0x04, 0x08, 0x14, 0x24, 0x34};

// Unpacks in both ways, which must agree. The sanitizers guard the ends of all arrays.
Channels unpacked(const Frame &frame) {
  alignas(4) uint8_t padded[3 + 25];
  std::copy(frame.begin(), frame.end(), padded + 3);
  Channels channels, aligned;
  sbus::unpack(frame.data(), channels.data());
  sbus::unpackAligned(padded + 3, aligned.data());
  REQUIRE(aligned == channels);
  return channels;
}

Frame packed(const Channels &channels, bool failsafe = false, bool lostFrame = false) {
  Frame frame;
  sbus::pack(frame.data(), channels.data(), failsafe, lostFrame);
  return frame;
}

LongChannels unpacked(const LongFrame &frame) {
  LongChannels channels;
  sbus::unpack24(frame.data(), channels.data());
  return channels;
}

LongFrame packed(const LongChannels &channels, bool failsafe = false, bool lostFrame = false) {
  LongFrame frame;
  sbus::pack24(frame.data(), channels.data(), failsafe, lostFrame);
  return frame;
}

std::array<uint16_t, 16> unpackedExtra(const Frame &frame) {
  std::array<uint16_t, 16> channels;
  sbus::unpackExtra(frame.data(), channels.data());
  return channels;
}

}  // namespace

TEST_CASE(
    "a frame begins with 0F, has flags 00..0F and ends with 00, 04, 08, 14, 24 or 34; other bytes may have any value") {
  for (unsigned byte = 0; byte < 256; byte++) {
    CAPTURE(byte);
    const bool isEnd = std::count(std::begin(EndBytes), std::end(EndBytes), byte) == 1;
    CHECK(sbus::isEndByte(static_cast<uint8_t>(byte)) == isEnd);
    CHECK(sbus::isFlagsByte(static_cast<uint8_t>(byte)) == (byte <= 0x0F));
    CHECK(sbus::isFrame(withByte(PaperLow.bytes, 0, byte).data()) == (byte == 0x0F));
    CHECK(sbus::isFrame(withByte(PaperLow.bytes, 23, byte).data()) == (byte <= 0x0F));
    CHECK(sbus::isFrame(withByte(PaperLow.bytes, 24, byte).data()) == isEnd);
    for (unsigned index = 1; index <= 22; index++) {
      REQUIRE(sbus::isFrame(withByte(PaperLow.bytes, index, byte).data()));
    }
  }
}

TEST_CASE("known frames are frames, have the known channels, and are written byte for byte, with end byte 00") {
  for (const KnownFrame &known : KnownFrames) {
    CAPTURE(known.source);
    CHECK(readBitByBit(known.bytes) == known.channels);
    CHECK(unpacked(known.bytes) == known.channels);
    CHECK(sbus::isFrame(known.bytes.data()));
    CHECK((sbus::Frame16::flags(known.bytes.data()) & (sbus::FlagLostFrame | sbus::FlagFailsafe)) == 0);
    CHECK(packed(known.channels) == withByte(known.bytes, 24, 0x00));
  }
}

template <typename Values>
void checkEveryValue(unsigned count) {
  for (const uint16_t others : {uint16_t{0}, uint16_t{2047}}) {
    for (unsigned channel = 0; channel < count; channel++) {
      for (uint16_t value = 0; value <= 2047; value++) {
        Values channels{};
        std::fill_n(channels.begin(), count, others);
        channels[channel] = value;
        const auto frame = writeBitByBit(channels);
        if (unpacked(frame) != channels || packed(channels) != frame) {
          FAIL("channel ", channel + 1, " of ", count, ", value ", value, ", all others ", others);
        }
      }
    }
  }
}

TEST_CASE("every channel, of 16 or 24, takes every value 0..2047, both ways, and leaves its neighbours alone") {
  checkEveryValue<Channels>(16);
  checkEveryValue<LongChannels>(24);
}

TEST_CASE("flags bits 0..3 are CH17, CH18, lost frame and failsafe, both ways; header and end byte are not read") {
  for (unsigned flags = 0; flags < 16; flags++) {
    CAPTURE(flags);
    const Frame frame = withByte(PaperLow.bytes, 23, flags);
    Channels channels = PaperLow.channels;
    channels[16] = (flags & 1) != 0;
    channels[17] = (flags & 2) != 0;
    CHECK(unpacked(frame) == channels);
    CHECK(unpacked(withByte(withByte(frame, 0, 0xFF), 24, 0xFF)) == channels);
    CHECK(sbus::Frame16::flags(frame.data()) == flags);
    CHECK(packed(channels, (flags & 8) != 0, (flags & 4) != 0) == frame);
  }
}

TEST_CASE("a channel above 2047 is sent as 2047 and spills into no neighbour, a switch other than 0 as 1") {
  const uint16_t values[] = {1, 2, 255, 256, 2048, 2049, 4095, 4096, 32768, 65535};
  for (const uint16_t value : values) {
    for (unsigned channel = 0; channel < 18; channel++) {
      INFO("value ", value, ", channel ", channel);
      Channels channels{};
      channels[channel] = value;
      Channels sent{};
      sent[channel] = channel < 16 ? std::min(value, uint16_t{2047}) : uint16_t{1};
      CHECK(packed(channels) == writeBitByBit(sent));
    }
  }
}

TEST_CASE("the published frame of 24 channels has the known channels, and is written byte for byte") {
  CHECK(readBitByBit(Published24.bytes) == Published24.channels);
  CHECK(unpacked(Published24.bytes) == Published24.channels);
  CHECK(packed(Published24.channels) == Published24.bytes);
}

TEST_CASE("24 channels: a value above 2047 is sent as 2047; byte 34 has lost frame and failsafe, byte 35 is 00") {
  for (unsigned channel = 0; channel < 24; channel++) {
    for (const uint16_t value : {uint16_t{2048}, uint16_t{4096}, uint16_t{65535}}) {
      INFO("channel ", channel, ", value ", value);
      LongChannels channels{}, sent{};
      channels[channel] = value;
      sent[channel] = 2047;
      CHECK(packed(channels) == writeBitByBit(sent));
    }
  }
  for (const unsigned flags : {0x00u, 0x04u, 0x08u, 0x0Cu}) {
    const LongFrame frame = withByte(Published24.bytes, 34, flags);
    CHECK(packed(Published24.channels, (flags & 8) != 0, (flags & 4) != 0) == frame);
    CHECK(unpacked(withByte(withByte(frame, 0, 0xFF), 35, 0xFF)) == Published24.channels);
  }
}

TEST_CASE("a frame with header 2F has 16 channels, packed as in any other, whatever its flags are") {
  for (const KnownFrame &known : KnownFrames) {
    for (unsigned channel = 0; channel < 16; channel++) {
      for (const unsigned value : {0u, 1u, 682u, 1365u, 2046u, 2047u}) {
        Channels channels = known.channels;
        channels[channel] = static_cast<uint16_t>(value);
        const Frame frame = withByte(withByte(writeBitByBit(channels), 0, 0x2F), 23, 0xFF);
        CHECK(unpackedExtra(frame) == readPayload<16>(frame));
        CHECK(unpackedExtra(frame)[channel] == value);
      }
    }
  }
}
