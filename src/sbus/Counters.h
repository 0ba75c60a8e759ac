/// @file
/// What a FrameFinder counts.
#pragma once

#include <stdint.h>

#include "Frame.h"

namespace sbus {

/// What was seen on the line since reset(). All but the period count up from 0, and wrap after 2^32.
struct Counters {
  uint32_t frames;          ///< delivered
  uint32_t lostFrames;      ///< of the delivered: with the lost-frame flag
  uint32_t failsafeFrames;  ///< of the delivered: with the failsafe flag

  uint32_t rejectedByEnd;    ///< 25 bytes from a 0F or 2F on, no end byte: one is missing, or that was no header
  uint32_t rejectedByFlags;  ///< 25 bytes from a 0F or 2F on, unused bits of the flags set
  uint32_t rejectedByLength;  ///< 25 bytes from a 0F or 2F on, more belong to them, or a gap lies within

  uint32_t discardedBytes;  ///< bytes that belonged to no frame: damaged ones, noise, telemetry, the R7003SB's tail
  uint32_t resyncs;       ///< frames found again after others had been missed
  uint32_t overflows;     ///< polls that found the port's buffer full: it has most probably dropped bytes
  uint32_t extraFrames;   ///< frames with header 2F: DecodeSBus::decodeExtraChannels() has their channels
  uint32_t otherSizeFrames;   ///< as many bytes between two gaps as a frame of 24 channels has; for DecodeSBus24, one of 16
  uint32_t period;        ///< us between frames delivered, smoothed over some eight; 0 before the second

  /// A frame with these flags is delivered, `interval` us after the one before; below 0 if a blocked loop() hides how
  /// late the one before came.
  void count(uint8_t flags, uint32_t interval) {
    if (static_cast<int32_t>(period) > 0) {
      period += static_cast<uint32_t>(static_cast<int32_t>(interval - period) >> 3);
    } else if (frames != 0 && static_cast<int32_t>(interval) > 0) {
      period = interval;
    }
    frames++;
    if ((flags & (FlagLostFrame | FlagFailsafe)) != 0) {
      lostFrames += (flags & FlagLostFrame) != 0;
      failsafeFrames += (flags & FlagFailsafe) != 0;
    }
  }
};

}  // namespace sbus
