// What the tests of the link share: times, frames with flags, and one check of all that the class says of the link.
#pragma once

#include <doctest/doctest.h>

#include "FakeClock.h"
#include "KnownFrames.h"
#include "ShowArrays.h"

#include "FakeBoard.h"

using sbus::LinkState;

constexpr uint64_t Ms = 1000;  // us
constexpr uint64_t Second = 1000 * Ms;
constexpr uint64_t Hour = 3600 * Second;

constexpr uint8_t Lost = sbus::FlagLostFrame;
constexpr uint8_t Failsafe = sbus::FlagFailsafe;

inline Frame withFlags(uint8_t flags) {
  Frame frame = PaperLow.bytes;
  frame[23] = flags;
  return frame;
}

// All that the class says of the link fits `state`, and decoding gives channels only if they may be trusted.
inline void checkState(OpenBoard &board, LinkState state) {
  const bool young = state != LinkState::NeverSeen && state != LinkState::Stale;
  CHECK(board.sbus.linkState() == state);
  CHECK(board.sbus.SBusFrameOk() == young);
  Channels before;
  before.fill(4711);
  const Decoded decoded = board.decode(before);
  CHECK((decoded.channels == before) == !young);
  CHECK(decoded.failsafe == (state != LinkState::Ok && state != LinkState::Lossy));
  if (!young) {
    CHECK(decoded.lostFrame);
  }
}
