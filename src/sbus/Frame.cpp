#include "Frame.h"

namespace sbus {

namespace {

constexpr uint8_t GroupChannels = 8;
constexpr uint8_t GroupBytes = 11;

// Eight channels fill eleven bytes exactly, so each bit position comes twice in a frame. The shifts are written out
// because a shift by a constant is one instruction on a Cortex-M0+. The cost of all 18 channels there, GCC 12.2, -Os:
//   bit by bit                     84 bytes of flash   3068 instructions
//   bytes shifted into a word      68                   405
//   unpack(), this one            178                   167
//   unpackAligned(), word by word 160                    84, for an aligned payload
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

void unpackGroups(const uint8_t *frame, uint16_t *channels, uint8_t groups) {
  const uint8_t *in = frame + PayloadIndex;
  for (; groups > 0; groups--, in += GroupBytes, channels += GroupChannels) {
    unpackGroup(in, channels);
  }
}

inline void unpackSwitches(uint8_t flags, uint16_t *channels) {
  channels[16] = flags & FlagChannel17;
  channels[17] = (flags & FlagChannel18) / FlagChannel18;
}

// Writes the header and the payload. Returns the place of the flags.
uint8_t *packChannels(uint8_t *out, const uint16_t *channels, uint8_t count) {
  *out++ = HeaderByte;
  uint32_t bits = 0;  // not yet written, the oldest lowest; at most 7 + 11 of them
  uint8_t waiting = 0;
  for (uint8_t i = 0; i < count; i++) {
    const uint32_t value = channels[i] > ChannelMax ? ChannelMax : channels[i];
    bits |= value << waiting;
    for (waiting = static_cast<uint8_t>(waiting + 11); waiting >= 8; waiting = static_cast<uint8_t>(waiting - 8)) {
      *out++ = static_cast<uint8_t>(bits & 0xFF);
      bits >>= 8;
    }
  }
  return out;
}

inline void packEnd(uint8_t *out, int switches, bool failsafe, bool lostFrame) {
  out[0] = static_cast<uint8_t>(switches | (lostFrame ? FlagLostFrame : 0) | (failsafe ? FlagFailsafe : 0));
  out[1] = 0x00;
}

}  // namespace

int innerHeader(const uint8_t *frame, int size, uint8_t variant) {
  int i = 2;
  while (i < size && ((frame[i] & HeaderMask) != HeaderByte ||
                      !(variant == NoVariant ? isEndByte(frame[i - 1]) : endsVariant(frame[i - 1], variant)))) {
    i++;
  }
  return i;
}

void unpack(const uint8_t *frame, ChannelArray<uint16_t, ChannelCount> channels) {
  unpackGroups(frame, channels, 2);
  unpackSwitches(frame[FlagsIndex], channels);
}

void unpackAligned(const uint8_t *frame, ChannelArray<uint16_t, ChannelCount> channels) {
  if (sizeof(int) < sizeof(uint32_t)) {
    return unpack(frame, channels);  // words are not faster on an AVR
  }
  const uint32_t *const words = reinterpret_cast<const uint32_t *>(__builtin_assume_aligned(frame + PayloadIndex, 4));
  const uint32_t w0 = words[0], w1 = words[1], w2 = words[2];
  channels[0] = w0 & ChannelMax;
  channels[1] = (w0 >> 11) & ChannelMax;
  channels[2] = (w0 >> 22 | w1 << 10) & ChannelMax;
  channels[3] = (w1 >> 1) & ChannelMax;
  channels[4] = (w1 >> 12) & ChannelMax;
  channels[5] = (w1 >> 23 | w2 << 9) & ChannelMax;
  channels[6] = (w2 >> 2) & ChannelMax;
  channels[7] = (w2 >> 13) & ChannelMax;
  const uint32_t w3 = words[3], w4 = words[4], w5 = words[5];
  channels[8] = (w2 >> 24 | w3 << 8) & ChannelMax;
  channels[9] = (w3 >> 3) & ChannelMax;
  channels[10] = (w3 >> 14) & ChannelMax;
  channels[11] = (w3 >> 25 | w4 << 7) & ChannelMax;
  channels[12] = (w4 >> 4) & ChannelMax;
  channels[13] = (w4 >> 15) & ChannelMax;
  channels[14] = (w4 >> 26 | w5 << 6) & ChannelMax;
  channels[15] = (w5 >> 5) & ChannelMax;
  unpackSwitches(static_cast<uint8_t>(w5 >> 16), channels);
}

void unpackExtra(const uint8_t *frame, ChannelArray<uint16_t, ProportionalCount> channels) {
  unpackGroups(frame, channels, 2);
}

void unpack24(const uint8_t *frame, ChannelArray<uint16_t, ChannelCount24> channels) {
  unpackGroups(frame, channels, 3);
}

void pack(uint8_t *frame, ChannelArray<const uint16_t, ChannelCount> channels, bool failsafe, bool lostFrame) {
  uint8_t *const flags = packChannels(frame, channels, ProportionalCount);
  packEnd(flags, (channels[16] != 0 ? FlagChannel17 : 0) | (channels[17] != 0 ? FlagChannel18 : 0), failsafe,
          lostFrame);
}

void pack24(uint8_t *frame, ChannelArray<const uint16_t, ChannelCount24> channels, bool failsafe, bool lostFrame) {
  packEnd(packChannels(frame, channels, ChannelCount24), 0, failsafe, lostFrame);
}

bool Frame16NoPulses::isZero(const uint8_t *frame) {
  constexpr uint8_t Whole = 4 * 11 / 8;  // bytes; then half of one
  uint8_t bits = frame[1 + Whole] & 0x0F;
  for (uint8_t at = 1; at <= Whole; at++) {
    bits = static_cast<uint8_t>(bits | frame[at]);
  }
  return bits == 0;
}

}  // namespace sbus
