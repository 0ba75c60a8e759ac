// Which channel a bit of a frame belongs to: the one in which sbus::unpack() finds it.
#include "ShownLine.h"

using namespace scope;

namespace {

uint8_t weight(unsigned value) {
  uint8_t bit = 0;
  while (value > 1) {
    value >>= 1;
    bit++;
  }
  return bit;
}

}  // namespace

// Returns the channel, from 0 on, plus 256 times the bit in the channel; -1 if the bit belongs to no channel.
EXPORT(ownerOfBit)(unsigned size, unsigned byte, unsigned bit)->int {
  const bool is24 = size == sbus::FrameSize24;
  if (byte >= size) {
    return -1;
  }
  alignas(4) uint8_t padded[3 + sbus::FrameSize24] = {};
  uint8_t *const frame = padded + 3;  // aligns the payload to a word
  frame[byte] = static_cast<uint8_t>(1u << bit);
  uint16_t channels[sbus::ChannelCount24] = {};
  if (is24) {
    sbus::unpack24(frame, channels);
  } else {
    sbus::unpack(frame, channels);
  }
  const int count = is24 ? sbus::ChannelCount24 : sbus::ChannelCount;
  for (int i = 0; i < count; i++) {
    if (channels[i] != 0) {
      return i | weight(channels[i]) << 8;
    }
  }
  return -1;
}
