// DecodeSBus on a plainer core, compiled with HOST_PLAIN_CORE: no SERIAL_SBUS, no read(buffer, size).
#include <doctest/doctest.h>

#include "KnownFrames.h"
#include "ShowArrays.h"

#include "FakeBoard.h"

#if !defined(HOST_PLAIN_CORE) || defined(SERIAL_SBUS)
#error "this program is about a core without SERIAL_SBUS"
#endif

namespace {

struct PlainBoard : OpenBoard {
  PlainBoard() : OpenBoard(63) {}
};

}  // namespace

TEST_CASE("begin opens the port at 100000 baud, SERIAL_8E2") {
  PlainBoard board;
  REQUIRE(board.port.openings.size() == 1);
  CHECK(board.port.openings[0].baud == 100000);
  CHECK(board.port.openings[0].config == SERIAL_8E2);
}

TEST_CASE("frames are read byte by byte, none missed and no byte read that is not there") {
  PlainBoard board;
  board.take(bytesOf({PaperLow.bytes}));
  CHECK(board.channels() == PaperLow.channels);
  board.take(bytesOf({Neutral.bytes, PaperHigh.bytes}));
  CHECK(board.channels() == PaperHigh.channels);
  CHECK(board.port.singleReads == 75);
  CHECK(board.port.available() == 0);
}

TEST_CASE("a look at an empty port reads nothing") {
  PlainBoard board;
  board.take({});
  CHECK(board.port.singleReads == 0);
  CHECK_FALSE(board.sbus.SBusFrameOk());
}

TEST_CASE("a buffer full with 63 bytes is full: the torn third frame is not completed from behind the break") {
  PlainBoard board;
  CHECK(board.take(bytesOf({PaperLow.bytes, PaperHigh.bytes, Neutral.bytes})) == 63);
  CHECK(board.channels() == PaperHigh.channels);
  board.take(part(PaperLow.bytes, 13));
  CHECK(board.channels() == PaperHigh.channels);
  board.take(bytesOf({Sbus2.bytes}) + Bytes{0x0F});  // behind a break a frame may wait for the next header
  CHECK(board.channels() == Sbus2.channels);
}
