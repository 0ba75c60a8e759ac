/// @file
/// Derives when a frame ended from when its port reported it, for an S.BUS2 sensor.
#pragma once

#include <stdint.h>

#include "../sbus/Frame.h"

namespace sbus {

/// Half of the ring of a port that hands over a half at once, characters: Dma16.
constexpr unsigned HalfRing = 16;

/// The moment at which a port counts a character as waiting.
enum class ReceiveNotice : uint8_t {
  Unknown,        ///< at an unknown time: a sensor does not answer there, except on an ESP32 (FifoWatch.h)
  EachCharacter,  ///< by an interrupt for each, in its first stop bit
  Fifo,           ///< in its first stop bit, even while interrupts are off
  Dma16,          ///< with the sixteenth since the last time, or when the line was idle for a character
};

/// The time from the end of a character's last stop bit until it waits, us.
struct NoticeDelay {
  int16_t least;  ///< negative: before the end of its last stop bit
  int16_t most;   ///< likewise
};

/// Returns the lag of a character when the port has handed over `found` characters at once.
inline NoticeDelay noticeDelayOf(ReceiveNotice notice, unsigned found) {
  constexpr int16_t Early = -15;  // the middle of the first of two stop bits
  constexpr int16_t Late = 10;    // an interrupt comes late by so much while others run
  constexpr int16_t Shown = -10;  // the end of the first stop bit
  const int16_t idle = notice == ReceiveNotice::Dma16 && found % HalfRing != 0 ? CharacterTime : 0;
  return {static_cast<int16_t>(idle + Early),
          static_cast<int16_t>(notice == ReceiveNotice::Fifo ? Shown : idle + Late)};
}

/// The bounds of the time at which a frame ended, us.
struct FrameEnd {
  uint32_t earliest;  ///< not before
  uint32_t latest;    ///< not after
};

/// Returns when a frame ended if its end was among the `found` characters of a poll at `by`, but not of one at
/// `before`.
inline FrameEnd frameEndOf(ReceiveNotice notice, unsigned found, uint32_t before, uint32_t by) {
  if (notice == ReceiveNotice::Unknown) {
    return {by - UINT16_MAX, by};
  }
  const NoticeDelay lag = noticeDelayOf(notice, found);
  return {before - static_cast<uint32_t>(lag.most), by - static_cast<uint32_t>(lag.least)};
}

/// Returns when a frame ended, for a port that called back at `before` and at `by`, with `found` characters between the
/// two. Other interrupts may delay a callback: both calls must predict the same end within 40 us, and the earlier
/// prediction counts.
inline FrameEnd frameEndOfCallback(ReceiveNotice notice, unsigned found, uint32_t before, uint32_t by) {
  constexpr int32_t DelayMax = 40;  // us
  const uint32_t end = by - (notice == ReceiveNotice::Dma16 && found % HalfRing != 0 ? CharacterTime : 0);
  const uint32_t same = before + found * CharacterTime;
  const int32_t heldUp = static_cast<int32_t>(end - same);
  if (notice == ReceiveNotice::Unknown || heldUp > DelayMax || heldUp < -DelayMax) {
    return {by - UINT16_MAX, by};
  }
  const uint32_t latest = heldUp > 0 ? same : end;
  return {latest - DelayMax, latest};
}

}  // namespace sbus
