// How DecodeSBus opens, reads and closes the port of the board's core.
#include <doctest/doctest.h>

#include "KnownFrames.h"
#include "ShowArrays.h"

#include "FakeBoard.h"

TEST_CASE("the constructor leaves the port alone") {
  FakeBoard board;
  CHECK(board.port.openings.empty());
  CHECK(board.port.closings == 0);
}

TEST_CASE("begin opens the port once, at 100000 baud, 8E2, inverted both ways") {
  FakeBoard board;
  board.sbus.begin();
  REQUIRE(board.port.openings.size() == 1);
  CHECK(board.port.openings[0].baud == 100000);
  CHECK(board.port.openings[0].config == (STM32L0_UART_OPTION_DATA_SIZE_8 | STM32L0_UART_OPTION_PARITY_EVEN |
                                       STM32L0_UART_OPTION_STOP_2 | STM32L0_UART_OPTION_RX_INVERT |
                                       STM32L0_UART_OPTION_TX_INVERT));
  CHECK(board.port.closings == 0);
}

TEST_CASE("begin(200000) opens the port for Fast S.Bus, inverted as ever") {
  FakeBoard board;
  board.sbus.begin(200000);
  REQUIRE(board.port.openings.size() == 1);
  CHECK(board.port.openings[0].baud == 200000);
  CHECK(board.port.openings[0].config == SERIAL_SBUS);
}

TEST_CASE("begin(baud, config) opens the port with exactly these") {
  const FakeSerial::Opening rows[] = {{200000, SERIAL_8E2}, {100000, SERIAL_8E2}, {200000, SERIAL_SBUS}, {115200, SERIAL_8N1},
                                        {9600, SERIAL_8E2},    {0, SERIAL_8E2},      {UINT32_MAX, SERIAL_8E2}};
  for (const FakeSerial::Opening &row : rows) {
    FakeBoard board;
    board.sbus.begin(row.baud, row.config);
    REQUIRE(board.port.openings.size() == 1);
    CHECK(board.port.openings[0].baud == row.baud);
    CHECK(board.port.openings[0].config == row.config);
    board.take(bytesOf({PaperHigh.bytes}));
    CHECK(board.channels() == PaperHigh.channels);
  }
}

TEST_CASE("end closes the port once, and the last frame can still be decoded") {
  FakeBoard board;
  board.sbus.begin();
  board.take(bytesOf({PaperHigh.bytes}));
  board.sbus.end();
  CHECK(board.port.closings == 1);
  CHECK(board.sbus.SBusFrameOk());
  CHECK(board.channels() == PaperHigh.channels);
}

TEST_CASE("begin after end starts clean: no frame, and no half of one") {
  FakeBoard board;
  board.sbus.begin();
  board.take(bytesOf({PaperHigh.bytes}));
  board.take(part(PaperLow.bytes, 0, 12));
  board.sbus.end();
  board.sbus.begin();
  CHECK(board.port.openings.size() == 2);
  CHECK_FALSE(board.sbus.SBusFrameOk());
  CHECK(board.decode().failsafe);
  board.take(part(PaperLow.bytes, 12));
  CHECK_FALSE(board.sbus.SBusFrameOk());
  board.take(bytesOf({Neutral.bytes}) + Bytes{0x0F});  // out of lock a frame may wait for the next header
  CHECK(board.channels() == Neutral.channels);
}

TEST_CASE("a look empties the port, and only by the cheap read(buffer, size)") {
  FakeBoard board;
  board.sbus.begin();
  for (unsigned count : {1u, 24u, 25u, 26u, 64u}) {
    CAPTURE(count);
    CHECK(board.take(Bytes(count, 0xA5)) == count);
    CHECK(board.port.available() == 0);
  }
  CHECK(board.port.singleReads == 0);
}
