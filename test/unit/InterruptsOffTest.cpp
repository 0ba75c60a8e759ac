// While interrupts are off, a UART keeps its first characters and loses the others: no frame is made of two.
#include <doctest/doctest.h>

#include "sbus/FrameFinder.h"
#include "support/Feed.h"
#include "support/ShowArrays.h"

namespace {

constexpr uint32_t GapUs = 6000;
constexpr uint32_t PeriodUs = 25 * Feeder::CharacterUs + GapUs;
constexpr unsigned Learnt = 8;  // frames

// Half the time of a clock that wraps, and nearly all of it: frames that are lost in 36 and in 71 minutes.
constexpr unsigned HalfClock = 36 * 60000 / 9, WholeClock = 71 * 60000 / 9;

// A line whose frames come every 9 ms, and a port that hands over each character at once.
struct Line : Feeder {
  unsigned number = 0;  // of the next frame

  Line() {
    finder.reset(now, CharacterUs, 0);
    settle(CharacterUs, ::GapUs);
    for (; number < Learnt; number++) {
      feed(bytesOf(plainFrame(number)));
      wait(::GapUs);
    }
    REQUIRE(finder.counters().frames == Learnt);
  }

  // Interrupts go off at this character of the next frame. The UART keeps some, and the line is at the same place of a
  // later frame when they are on again. Returns what is delivered up to the end of the frame after that.
  Frames join(size_t at, size_t kept, unsigned lostFrames) {
    Bytes bytes;
    for (unsigned i = 0; i < 3; i++) {
      bytes = bytes + bytesOf(plainFrame(number + i));
    }
    const size_t last = at + kept;
    const unsigned ended = static_cast<unsigned>(last / 25);
    const unsigned later = number + ended + lostFrames;
    Frames frames = feed(part(bytes, 0, at));
    block(static_cast<uint32_t>(kept) * CharacterUs + ended * ::GapUs + lostFrames * PeriodUs);
    frames = frames + poll(part(bytes, at, last));
    frames = frames + feed(part(plainFrame(later), last % 25));
    frames = frames + wait(::GapUs).waited;
    return frames + feed(bytesOf(plainFrame(later + 1)));
  }

  // Returns the frames that are whole on such a line.
  Frames whole(size_t at, size_t kept, unsigned lostFrames) const {
    Frames frames;
    const unsigned ended = static_cast<unsigned>((at + kept) / 25);
    for (unsigned i = 0; i < ended; i++) {
      frames.push_back(plainFrame(number + i));
    }
    if ((at + kept) % 25 == 0) {
      frames.push_back(plainFrame(number + ended + lostFrames));
    }
    frames.push_back(plainFrame(number + ended + lostFrames + 1));
    return frames;
  }
};

}  // namespace

TEST_CASE("a frame that breaks off while interrupts are off is joined to no other, whatever its UART keeps") {
  for (const size_t kept : {3u, 32u}) {
    for (size_t at = 1; at + 3 < 25; at++) {
      for (const unsigned lostFrames : {1u, 2u, 9u, HalfClock, WholeClock}) {
        INFO("kept ", kept, ", at ", at, ", lostFrames ", lostFrames);
        Line line;
        const Frames whole = line.whole(at, kept, lostFrames);
        CHECK(line.join(at, kept, lostFrames) == whole);
        CHECK(line.finder.counters().shortfalls == (kept == 32 ? 1 : 0));  // 3: the line may have lost some
        CHECK(line.finder.counters().overflows == 0);
      }
    }
  }
}

TEST_CASE("no shortfall is counted while the period is unknown, nor if no poll finds nothing") {
  Feeder young;
  young.settle().feed(bytesOf(plainFrame(0)));
  young.block(100000).poll({0x0F, 0x01});
  young.feed({0x02});
  CHECK(young.finder.counters().shortfalls == 0);

  Feeder byEvents;
  for (unsigned number = 0; number < 20; number++) {
    byEvents.feed(bytesOf(plainFrame(number)));
    byEvents.block(Feeder::GapUs);
  }
  byEvents.block(100000).poll({0x0F, 0x01});
  byEvents.feed({0x02});
  CHECK(byEvents.finder.counters().shortfalls == 0);
}
