// DecodeSBus on a plainer core, compiled with HOST_PLAIN_CORE: no SERIAL_SBUS, no read(buffer, size).
#include <doctest/doctest.h>

#include "support/KnownFrames.h"
#include "support/ShowArrays.h"

#include "support/FakeBoard.h"

#if !defined(HOST_PLAIN_CORE) || defined(SERIAL_SBUS)
#error "this program is about a core without SERIAL_SBUS"
#endif

namespace {

// Its port hands over each character at once, and loop() is quick.
struct PlainBoard : OpenBoard {
  PlainBoard() : OpenBoard(63) {
    frame(Neutral.bytes);
    wait(SilenceUs);
    _before = sbus.counters();
    port.singleReads = 0;
  }

  void frame(const Frame &frame) {
    for (const uint8_t byte : frame) {
      wait(120);
      poll({byte});
    }
  }
  void nextFrame(const Frame &next) {
    wait(9 * Ms - FrameUs);
    frame(next);
  }
  sbus::Counters counted() const { return sbus.counters() - _before; }

 private:
  sbus::Counters _before;
};

}  // namespace

TEST_CASE(
    "begin() opens the port at SERIAL_8E2; frames are read byte by byte: none is missed, no byte is read too early") {
  PlainBoard board;
  CHECK(board.port.openings.back().baud == 100000);
  CHECK(board.port.openings.back().config == SERIAL_8E2);
  board.take({});
  CHECK(board.port.singleReads == 0);
  board.frame(PaperLow.bytes);
  CHECK(board.channels() == PaperLow.channels);
  board.take(join({Neutral.bytes, PaperHigh.bytes}));
  CHECK(board.counted().frames == 3);
  CHECK(board.channels() == PaperHigh.channels);
  CHECK(board.port.singleReads == 75);
  CHECK(board.port.available() == 0);
}

TEST_CASE(
    "a buffer that holds 63 bytes at most is full with 63: what follows the break does not complete the torn third "
    "frame") {
  PlainBoard board;
  board.frame(Sbus2.bytes);
  CHECK(board.take(join({PaperLow.bytes, PaperHigh.bytes, Neutral.bytes})) == 63);
  CHECK(board.channels() == PaperHigh.channels);
  board.take(part(PaperLow.bytes, 13));
  CHECK(board.counted().frames == 3);
  CHECK(board.counted().overflows == 1);
  board.nextFrame(Neutral.bytes);
  CHECK(board.channels() == Neutral.channels);
}

TEST_CASE("a port that hands over each character at once shows a gap from two characters of silence on") {
  for (const uint32_t quietUs : {240u, 241u}) {
    CAPTURE(quietUs);
    PlainBoard board;
    for (unsigned index = 0; index < 25; index++) {
      board.wait(index == 13 ? quietUs : 120);
      board.poll({PaperLow.bytes[index]});
    }
    CHECK(board.counted().frames == (quietUs == 240));
  }
}
