// A second implementation of the S.Bus frame, as slow and plain as its definition: bit k of channel c (from 0) is bit
// (11c + k) mod 8 of byte 1 + (11c + k) / 8. The tests compare the library with it; it includes nothing from it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

using Frame = std::array<uint8_t, 25>;
using Channels = std::array<uint16_t, 18>;

// FrSky's 24 channels.
using LongFrame = std::array<uint8_t, 36>;
using LongChannels = std::array<uint16_t, 24>;

// Returns the first `Count` channels of any frame, by the bits of its payload.
template <size_t Count, size_t Size>
std::array<uint16_t, Count> readPayload(const std::array<uint8_t, Size> &frame) {
  std::array<uint16_t, Count> channels{};
  for (unsigned bit = 0; bit < Count * 11; bit++) {
    const unsigned value = (frame[1 + bit / 8] >> bit % 8 & 1) != 0 ? 1u << bit % 11 : 0u;
    channels[bit / 11] = static_cast<uint16_t>(channels[bit / 11] | value);
  }
  return channels;
}

// Returns the header and the first `Count` of `channels` (0..2047), all other bits 0.
template <size_t Count, size_t Size, typename Values>
std::array<uint8_t, Size> writePayload(const Values &channels) {
  std::array<uint8_t, Size> frame{};
  frame[0] = 0x0F;
  for (unsigned bit = 0; bit < Count * 11; bit++) {
    if ((channels[bit / 11] >> bit % 11 & 1) != 0) {
      uint8_t &byte = frame[1 + bit / 8];
      byte = static_cast<uint8_t>(byte | 1u << bit % 8);
    }
  }
  return frame;
}

// Returns CH1..CH16 from the payload, CH17 and CH18 from bits 0 and 1 of byte 23.
inline Channels readBitByBit(const Frame &frame) {
  const std::array<uint16_t, 16> first = readPayload<16>(frame);
  Channels channels{};
  for (unsigned i = 0; i < 16; i++) {
    channels[i] = first[i];
  }
  channels[16] = frame[23] & 1;
  channels[17] = frame[23] >> 1 & 1;
  return channels;
}
inline LongChannels readBitByBit(const LongFrame &frame) { return readPayload<24>(frame); }

// Returns the whole frame for `channels` (0..2047, CH17 and CH18 0 or 1), with neither lost frame nor failsafe, end
// byte 00.
inline Frame writeBitByBit(const Channels &channels) {
  Frame frame = writePayload<16, 25>(channels);
  frame[23] = static_cast<uint8_t>(channels[16] | channels[17] << 1);
  return frame;
}
inline LongFrame writeBitByBit(const LongChannels &channels) { return writePayload<24, 36>(channels); }
