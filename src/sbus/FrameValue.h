/// @file
/// A frame as a value: DecodeSBus::read() writes it, and EncodeSBus::write() sends it.
#pragma once

#include <limits.h>
#include <stdint.h>

#include "Frame.h"

namespace sbus {

/// `Count` channels and the flags. Until a frame has come, both flags are true.
template <uint8_t Count>
struct FrameValue {
  uint16_t channels[Count] = {};  ///< CH1 is channels[0]; 0..2047
  bool lostFrame = true;          ///< this radio frame did not arrive, and the channels repeat old values
  bool failsafe = true;           ///< the link is lost: no frames come, or the receiver is in failsafe
  unsigned long age = ULONG_MAX;  ///< ms, when read() was called last; ULONG_MAX before the first frame
};

}  // namespace sbus

/// CH1..CH16, two switches and the flags, for DecodeSBus and EncodeSBus.
struct SBusFrame : sbus::FrameValue<sbus::ChannelCount> {
  bool ch17() const { return channels[16] != 0; }  ///< returns the switch CH17
  bool ch18() const { return channels[17] != 0; }  ///< returns the switch CH18
};

/// CH1..CH24 and the flags, for DecodeSBus24 and EncodeSBus24.
using SBusFrame24 = sbus::FrameValue<sbus::ChannelCount24>;
