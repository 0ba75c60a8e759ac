// FrSky's 24 channels: how the class decodes them, and that no line is taken for one of the other size.
#include <doctest/doctest.h>

#include <climits>

#include "support/Feed.h"
#include "support/FakeBoard.h"
#include "support/KnownFrames.h"
#include "support/ShowArrays.h"

using sbus::LinkState;

namespace {

struct Board24 : FakeBoardOf<DecodeSBus24, sbus::Frame24> {
  Board24() { sbus.begin(); }

  void expect(const LongChannels &channels, bool failsafe, bool lostFrame) {
    LongChannels decoded = UntouchedLong;
    bool isFailsafe = !failsafe, isLost = !lostFrame;
    sbus.decodeSBusFrame(decoded.data(), isFailsafe, isLost);
    CHECK(decoded == channels);
    CHECK(isFailsafe == failsafe);
    CHECK(isLost == lostFrame);
  }
};

}  // namespace

TEST_CASE("a line with frames of the other size brings no frame, and all of its frames but the last are counted") {
  for (const bool neutral : {false, true}) {
    for (const uint64_t gapUs : {2700u, 4700u, 9700u}) {
      TimedLine longs, shorts;
      for (unsigned number = 0; number < 40; number++) {
        longs.send(longFrame(number, neutral)).gap(gapUs);
        shorts.send(neutral ? neutralFrame(number) : plainFrame(number)).gap(gapUs);
      }
      for (const uint32_t loopUs : {50u, 500u}) {
        INFO("neutral ", neutral, ", gapUs ", gapUs, ", loopUs ", loopUs);
        sbus::Counters counters;
        CHECK(longs.frames(loopUs, &counters).empty());
        CHECK(counters.otherSizeFrames == 39);
        CHECK(shorts.frames<sbus::Frame24>(loopUs, &counters).empty());
        CHECK(counters.otherSizeFrames == 39);
        CHECK(shorts.frames(loopUs, &counters).size() == 40);
        CHECK(counters.otherSizeFrames == 0);
      }
    }
  }
}

TEST_CASE("DecodeSBus24 decodes 24 channels, and the flags of byte 34; the flags and the timeout decide on the link") {
  const struct {
    unsigned flags;
    LinkState state;
  } rows[] = {{0x00, LinkState::Ok},
              {0x03, LinkState::Ok},
              {0x04, LinkState::Lossy},
              {0x08, LinkState::Failsafe},
              {0x0C, LinkState::Failsafe}};
  for (const auto &row : rows) {
    CAPTURE(row.flags);
    Board24 board;
    CHECK(board.port.openings.back().baud == 100000);
    CHECK(board.sbus.linkState() == LinkState::NeverSeen);
    board.expect(UntouchedLong, true, true);
    board.firstFrame(longFrame(1));
    board.nextFrame(withByte(Published24.bytes, 34, row.flags));
    CHECK(board.sbus.counters().frames == 2);
    CHECK(board.sbus.counters().lostFrames == ((row.flags & 4) != 0));
    CHECK(board.sbus.counters().failsafeFrames == ((row.flags & 8) != 0));
    CHECK(board.sbus.linkState() == row.state);
    CHECK(board.sbus.newFrame());
    CHECK(board.sbus.frameAge() == 0);
    board.expect(Published24.channels, (row.flags & 8) != 0, (row.flags & 4) != 0);
    CHECK_FALSE(board.sbus.newFrame());
    fakeMicros += 99 * Ms;
    board.expect(Published24.channels, (row.flags & 8) != 0, (row.flags & 4) != 0);
    fakeMicros += 1 * Ms;
    CHECK(board.sbus.linkState() == LinkState::Stale);
    board.expect(UntouchedLong, true, true);
    board.sbus.begin();
    CHECK(board.sbus.linkState() == LinkState::NeverSeen);
    CHECK(board.sbus.frameAge() == ULONG_MAX);
  }
}
