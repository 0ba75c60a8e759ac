/// @file
/// The counters of a FrameFinder.
#pragma once

#include <stdint.h>

#include "Frame.h"

namespace sbus {

/// Counts frames, bytes and faults on the line since reset(). All members except the period count up from 0, and wrap
/// after 2^32.
struct Counters {
  uint32_t frames;          ///< frames delivered
  uint32_t lostFrames;      ///< frames delivered with the lost-frame flag
  uint32_t failsafeFrames;  ///< frames delivered with the failsafe flag

  /// a header, 0F or 2F, but no end byte 24 bytes later: a byte is missing, or it was no header
  uint32_t rejectedByEnd;
  uint32_t rejectedByFlags;   ///< a header and an end byte, but unused bits of the flags are set
  uint32_t rejectedByLength;  ///< the form of a frame, but with further bytes or a gap inside

  uint32_t discardedBytes;   ///< bytes that belong to no frame: of impaired frames, noise, telemetry
  uint32_t resyncs;          ///< how often frames were found again after some had been missed
  uint32_t overflows;        ///< polls that found the port's buffer full: it has probably lost bytes
  uint32_t shortfalls;       ///< late polls that found too few bytes, or, on an AVR, frames that this may have joined:
                             ///< interrupts were off
  uint32_t extraFrames;      ///< frames with header 2F, which only a DecodeSBus32 accepts
  uint32_t otherSizeFrames;  ///< as many bytes between two gaps as a frame of 24 channels has (DecodeSBus24: of 16)
  uint32_t period;           ///< us, frame interval, smoothed over about eight frames; 0 before the second frame

  /// @cond  For the classes of this library.

  /// Takes the time between two frames, us; more than two periods count as two. Ignores a negative first interval:
  /// loop() was blocked.
  void measure(uint32_t interval) {
    const int32_t before = static_cast<int32_t>(period);
    if (before > 0) {
      const int32_t longer = static_cast<int32_t>(interval - period);
      period += static_cast<uint32_t>((longer < before ? longer : before) >> 3);
    } else if (static_cast<int32_t>(interval) > 0) {
      period = interval;
    }
  }

  /// Counts a frame with these flags.
  void count(uint8_t flags) {
    frames++;
    if ((flags & (FlagLostFrame | FlagFailsafe)) != 0) {
      lostFrames += (flags & FlagLostFrame) != 0;
      failsafeFrames += (flags & FlagFailsafe) != 0;
    }
  }

  /// @endcond
};

}  // namespace sbus
