// A second reading of the S.Bus frame, as slow and plain as its definition: bit k of channel c (from 0) is bit
// (11c + k) mod 8 of byte 1 + (11c + k) / 8. The tests hold the library against it; it includes nothing of the library.
#pragma once

#include <array>
#include <cstdint>

using Frame = std::array<uint8_t, 25>;
using Channels = std::array<uint16_t, 18>;

constexpr unsigned PayloadBits = 16 * 11;

inline void setBit(Frame &frame, unsigned payloadBit, bool value) {
  const unsigned mask = 1u << payloadBit % 8;
  uint8_t &byte = frame[1 + payloadBit / 8];
  byte = static_cast<uint8_t>(value ? byte | mask : byte & ~mask);
}

inline bool getBit(const Frame &frame, unsigned payloadBit) {
  return (frame[1 + payloadBit / 8] >> payloadBit % 8 & 1) != 0;
}

// CH1..CH16 out of the payload, CH17 and CH18 out of bits 0 and 1 of byte 23.
inline Channels readBitByBit(const Frame &frame) {
  Channels channels{};
  for (unsigned bit = 0; bit < PayloadBits; bit++) {
    const unsigned value = getBit(frame, bit) ? 1u << bit % 11 : 0u;
    channels[bit / 11] = static_cast<uint16_t>(channels[bit / 11] | value);
  }
  channels[16] = frame[23] & 1;
  channels[17] = frame[23] >> 1 & 1;
  return channels;
}

// The whole frame for `channels` (0..2047, CH17 and CH18 0 or 1), with neither lost frame nor failsafe, end byte 00.
inline Frame writeBitByBit(const Channels &channels) {
  Frame frame{};
  frame[0] = 0x0F;
  for (unsigned bit = 0; bit < PayloadBits; bit++) {
    setBit(frame, bit, (channels[bit / 11] >> bit % 11 & 1) != 0);
  }
  frame[23] = static_cast<uint8_t>(channels[16] | channels[17] << 1);
  return frame;
}
