#include "Frame.h"

namespace sbus {

namespace {

constexpr uint8_t GroupChannels = 8;
constexpr uint8_t GroupBytes = 11;

// Eight channels fill eleven bytes exactly, so the same bit positions come twice in a frame. Written out, because a
// shift by a constant is one instruction on a Cortex-M0+ and a loop over bits some thousand.
void unpackGroup(const uint8_t *in, uint16_t *out) {
  const unsigned mask = ChannelMax;
  const auto byte = [in](uint8_t index) -> unsigned { return in[index]; };
  out[0] = (byte(0) | byte(1) << 8) & mask;
  out[1] = (byte(1) >> 3 | byte(2) << 5) & mask;
  out[2] = (byte(2) >> 6 | byte(3) << 2 | byte(4) << 10) & mask;
  out[3] = (byte(4) >> 1 | byte(5) << 7) & mask;
  out[4] = (byte(5) >> 4 | byte(6) << 4) & mask;
  out[5] = (byte(6) >> 7 | byte(7) << 1 | byte(8) << 9) & mask;
  out[6] = (byte(8) >> 2 | byte(9) << 6) & mask;
  out[7] = (byte(9) >> 5 | byte(10) << 3) & mask;
}

}  // namespace

void unpack(const uint8_t *frame, uint16_t *channels) {
  unpackGroup(frame + PayloadIndex, channels);
  unpackGroup(frame + PayloadIndex + GroupBytes, channels + GroupChannels);
  const uint8_t flags = frame[FlagsIndex];
  channels[16] = (flags & FlagChannel17) != 0;
  channels[17] = (flags & FlagChannel18) != 0;
}

void pack(uint8_t *frame, const uint16_t *channels, bool failsafe, bool lostFrame) {
  uint8_t *out = frame;
  *out++ = HeaderByte;
  uint32_t bits = 0;  // not yet written, the oldest lowest; never more than 7 + 11
  uint8_t count = 0;
  for (uint8_t i = 0; i < ProportionalCount; i++) {
    const uint32_t value = channels[i] > ChannelMax ? ChannelMax : channels[i];
    bits |= value << count;
    for (count = static_cast<uint8_t>(count + 11); count >= 8; count = static_cast<uint8_t>(count - 8)) {
      *out++ = static_cast<uint8_t>(bits & 0xFF);
      bits >>= 8;
    }
  }
  *out++ = static_cast<uint8_t>((channels[16] != 0 ? FlagChannel17 : 0) | (channels[17] != 0 ? FlagChannel18 : 0) |
                                (lostFrame ? FlagLostFrame : 0) | (failsafe ? FlagFailsafe : 0));
  *out = 0x00;
}

}  // namespace sbus
