#include "UnpackWays.h"

#include "sbus/Frame.h"

namespace {

constexpr unsigned ChannelBits = 11;

void unpackSwitches(const uint8_t *frame, uint16_t *channels) {
  channels[16] = frame[sbus::FlagsIndex] & sbus::FlagChannel17;
  channels[17] = (frame[sbus::FlagsIndex] & sbus::FlagChannel18) / sbus::FlagChannel18;
}

}  // namespace

void unpackBitByBit(const uint8_t *frame, uint16_t *channels) {
  const uint8_t *const payload = frame + sbus::PayloadIndex;
  unsigned at = 0;
  for (unsigned channel = 0; channel < sbus::ProportionalCount; channel++) {
    unsigned value = 0;
    for (unsigned bit = 0; bit < ChannelBits; bit++, at++) {
      if ((payload[at / 8] >> (at % 8) & 1) != 0) {
        value |= 1u << bit;
      }
    }
    channels[channel] = static_cast<uint16_t>(value);
  }
  unpackSwitches(frame, channels);
}

void unpackShifting(const uint8_t *frame, uint16_t *channels) {
  const uint8_t *in = frame + sbus::PayloadIndex;
  uint32_t bits = 0;
  unsigned count = 0;
  for (unsigned channel = 0; channel < sbus::ProportionalCount; channel++) {
    for (; count < ChannelBits; count += 8) {
      bits |= static_cast<uint32_t>(*in++) << count;
    }
    channels[channel] = bits & sbus::ChannelMax;
    bits >>= ChannelBits;
    count -= ChannelBits;
  }
  unpackSwitches(frame, channels);
}
