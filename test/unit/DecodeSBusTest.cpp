// The class DecodeSBus on a fake port of the board's core: how it opens, reads and closes the port, which frame it
// returns when, and what a full buffer does.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <new>
#include <random>

#include "support/FakeBoard.h"
#include "support/KnownFrames.h"
#include "support/ShowArrays.h"
#include "support/UartPort.h"

TEST_CASE(
    "the constructor leaves the port alone; begin() opens it once, at 100000 baud, 8E2, inverted, or with other "
    "settings") {
  FakeBoard board;
  CHECK(board.port.openings.empty());
  board.sbus.begin();
  CHECK(board.port.openings.back().baud == 100000);
  CHECK(board.port.openings.back().config ==
        (STM32L0_UART_OPTION_DATA_SIZE_8 | STM32L0_UART_OPTION_PARITY_EVEN | STM32L0_UART_OPTION_STOP_2 |
         STM32L0_UART_OPTION_RX_INVERT | STM32L0_UART_OPTION_TX_INVERT));
  for (const unsigned long baud : {47060ul, 115200ul, 200000ul, 4294967295ul}) {
    for (const uint32_t config : {uint32_t{SERIAL_SBUS}, uint32_t{SERIAL_8E2}, uint32_t{SERIAL_8N1}}) {
      config == SERIAL_SBUS ? board.sbus.begin(baud) : board.sbus.begin(baud, config);
      CHECK(board.port.openings.back().baud == baud);
      CHECK(board.port.openings.back().config == config);
    }
  }
  for (const unsigned long slow : {0ul, 9600ul, 47059ul}) {  // never S.Bus; cores divide by 0
    board.sbus.begin(slow);
  }
  CHECK(board.port.openings.size() == 13);
  CHECK(board.port.closings == 0);
}

TEST_CASE(
    "end() closes the port, and the last frame can still be decoded; begin() forgets it, and an incomplete frame") {
  OpenBoard board;
  board.firstFrame(PaperHigh.bytes);
  board.take(part(PaperLow.bytes, 0, 12));
  board.sbus.end();
  CHECK(board.port.closings == 1);
  CHECK(board.channels() == PaperHigh.channels);
  board.sbus.begin();
  CHECK(board.channels() == Untouched);
  board.take(part(PaperLow.bytes, 12));
  board.wait(FakeBoard::SilenceUs);
  CHECK(board.sbus.counters().frames == 0);
}

TEST_CASE("before begin(), whatever its memory held, there is no frame, none is new, and a poll finds nothing") {
  for (const int garbage : {0x00, 0x0F, 0xFF}) {
    CAPTURE(garbage);
    FakeSerial port;
    alignas(DecodeSBus) unsigned char memory[sizeof(DecodeSBus)];
    std::memset(memory, garbage, sizeof memory);
    DecodeSBus &sbus = *new (memory) DecodeSBus(port);
    sbus.parseSBusFrame();
    CHECK_FALSE(sbus.newFrame());
    CHECK(sbus.linkState() == sbus::LinkState::NeverSeen);
    CHECK(sbus.counters().frames + sbus.counters().discardedBytes == 0);
  }
}

// The board's core, asked for more bytes than wait, writes those that come meanwhile past the end of the buffer.
TEST_CASE("the port is never asked for more bytes than it has; nothing is overwritten, whatever comes meanwhile") {
  for (size_t held = 0; held < 25; held++) {
    for (size_t waiting = 1; waiting <= 64; waiting++) {
      INFO("held ", held, ", waiting ", waiting);
      SyncedBoard board;
      board.sbus.setTimeout(50);
      board.nextFrame(PaperLow.bytes);
      board.take(part(PaperHigh.bytes, 0, held));
      const auto before = board.sbus.counters().frames;
      board.port.asked = 0;
      board.port.landing = Bytes(64, 0xA5);
      board.port.arrive(Bytes(waiting, 0xA5));
      board.sbus.parseSBusFrame();
      CHECK(board.port.overasked == 0);
      CHECK(board.port.available() == 0);
      CHECK(board.port.asked == (waiting > 31 ? 3 : 2));  // one of them here
      CHECK(board.port.singleReads == 0);
      CHECK(board.sbus.counters().frames == before);
      CHECK(board.channels() == PaperLow.channels);
      // The timeout stands next to the frames.
      board.wait(50 * Ms);
      CHECK(board.sbus.linkState() == sbus::LinkState::Stale);
    }
  }
}

TEST_CASE("the whole frames in a full buffer count, also one that began before; the torn frame is never completed") {
  for (unsigned held = 0; held < 25; held++) {
    CAPTURE(held);
    SyncedBoard board;
    board.frame(plainFrame(0));
    board.take(part(plainFrame(1), 0, held));
    const Bytes line = join({plainFrame(1), plainFrame(2), plainFrame(3), plainFrame(4)});
    CHECK(board.take(part(line, held)) == 64);
    const unsigned whole = (held + 64) / 25;
    const unsigned torn = (held + 64) % 25;
    CHECK(board.channels() == readBitByBit(plainFrame(whole)));
    CHECK(board.counted().overflows == 1);
    // After the break come as many bytes as the torn frame lacks, but of another frame.
    board.take(part(plainFrame(5), torn == 0 ? 25 : torn));
    CHECK(board.counted().frames == 1 + whole);
    board.nextFrame(plainFrame(6));
    CHECK(board.channels() == readBitByBit(plainFrame(6)));
  }
}

TEST_CASE("bytes that fill the buffer while it is read break the line there, and no frame is made of parts of two") {
  // All channels of a frame are equal, so that a mixture shows.
  const auto frame = [](unsigned number) {
    Channels channels{};
    std::fill_n(channels.begin(), 16, static_cast<uint16_t>(1000 + 30 * number));
    return writeBitByBit(channels);
  };
  for (size_t found = 38; found <= 64; found++) {  // in two reads or more
    for (const unsigned beforeRead : {1u, 2u}) {
      for (size_t resumed = 0; resumed < 25; resumed++) {  // the line goes on at this place of a later frame
        INFO("found ", found, ", beforeRead ", beforeRead, ", resumed ", resumed);
        SyncedBoard board;
        board.frame(frame(0));
        const Bytes line = join({frame(1), frame(2), frame(3), frame(4), frame(5), frame(6), frame(7)});
        unsigned reads = 0;
        board.port.beforeRead = [&] {
          if (++reads == beforeRead) {
            board.port.arrive(part(line, found));
          }
        };
        board.take(part(line, 0, found));
        board.sbus.parseSBusFrame();
        CHECK(board.counted().overflows >= 1);
        for (const Bytes &next : {part(frame(8), resumed), bytesOf(frame(9)), bytesOf(frame(10))}) {
          const Channels channels = board.channels();
          CHECK(std::count(channels.begin(), channels.begin() + 16, channels[0]) == 16);
          board.take(next);
        }
        CHECK(board.channels() == readBitByBit(frame(10)));
      }
    }
  }
}

// The driver hands over 16 bytes at a time, and a buffer that is found full, 64, may have been full for long: then the
// frame at its end is discarded. Polls that are 48 characters apart never find it full.
TEST_CASE("a line without gaps is read whole by polls every 5 ms, at 200000 baud 2.5 ms, and 48 characters apart") {
  const struct {
    unsigned long baud;
    uint32_t loopUs;
    bool whole;
  } rows[] = {{100000, 5000, true}, {100000, 5760, true}, {100000, 5900, false}, {100000, 7680, false},
              {200000, 2500, true}, {200000, 2880, true}, {200000, 2950, false}, {200000, 3840, false}};
  Frames frames;
  for (unsigned number = 0; number < 60; number++) {
    frames.push_back(number < 30 ? neutralFrame(number) : plainFrame(number));
  }
  const Bytes bytes = join(frames) + Bytes{0x0F};
  for (const auto &row : rows) {
    INFO("baud ", row.baud, ", loopUs ", row.loopUs);
    fakeMicros = 0;
    UartPort port(row.baud);
    DecodeSBus sbus(port);
    sbus.begin(row.baud);
    const uint32_t characterUs = line::LineSettings{row.baud}.characterUs();
    for (size_t next = 0; fakeMicros < bytes.size() * characterUs + row.loopUs; sbus.parseSBusFrame()) {
      fakeMicros += row.loopUs;
      for (; next < bytes.size() && (next + 1) * characterUs <= fakeMicros; next++) {
        port.receive({(next + 1) * characterUs, bytes[next], false});
      }
      port.advance(fakeMicros);
    }
    CHECK((sbus.counters().frames == frames.size()) == row.whole);
    CHECK((sbus.counters().overflows == 0) == row.whole);
    // Up to 64 characters apart the buffer takes all bytes: frames are lost by caution only.
    CHECK(port.droppedFull() == 0);
  }
}

TEST_CASE(
    "silence within a frame rejects it: read byte by byte more than five characters, polled by events eight and some "
    "us") {
  const struct {
    unsigned long baud;
    bool byEvents;     // the sketch polls only when a byte has come
    uint32_t quietUs;  // between two bytes of the third frame
    bool rejected;
  } rows[] = {{100000, false, 120, false}, {100000, false, 600, false}, {100000, false, 601, true},
              {200000, false, 60, false},  {200000, false, 300, false}, {200000, false, 301, true},
              {47060, false, 254, false},  {47060, false, 1270, false}, {47060, false, 1271, true},  // the slowest
              {100000, true, 120, false},  {100000, true, 963, false},  {100000, true, 964, true},
              {200000, true, 60, false},   {200000, true, 481, false},  {200000, true, 482, true},
              {47060, true, 254, false},   {47060, true, 2039, false},  {47060, true, 2040, true}};
  for (const auto &row : rows) {
    INFO("baud ", row.baud, ", byEvents ", row.byEvents, ", quietUs ", row.quietUs);
    const uint32_t characterUs = static_cast<uint32_t>(12000000 / row.baud);
    FakeBoard board;
    board.sbus.begin(row.baud);
    for (unsigned index = 0; index < 5 * 25; index++) {
      const uint32_t us = index % 25 == 0 ? 50 * characterUs : characterUs;
      board.block(index == 2 * 25 + 13 ? row.quietUs : us);
      if (!row.byEvents) {
        board.poll({});
      }
      board.poll({plainFrame(index / 25)[index % 25]});
    }
    CHECK(board.sbus.counters().frames == (row.rejected ? 4 : 5));
    CHECK(board.sbus.counters().rejectedByLength == row.rejected);
  }
}

TEST_CASE("a Stream that is no hardware serial port is not opened, and is read byte by byte; no frame is missed") {
  FakeSerial port;
  port.begin(100000, SERIAL_8E2);
  DecodeSBus sbus(static_cast<Stream &>(port));
  sbus.begin();
  CHECK(port.openings.size() == 1);
  for (unsigned number = 0; number < 10; number++) {
    fakeMicros += 6 * Ms;
    sbus.parseSBusFrame();
    for (const uint8_t value : plainFrame(number)) {
      fakeMicros += 120;
      port.arrive(Bytes{value});
      sbus.parseSBusFrame();
    }
  }
  fakeMicros += 6 * Ms;
  sbus.parseSBusFrame();
  CHECK(sbus.counters().frames == 10);
  CHECK(sbus.counters().discardedBytes == 0);
  CHECK(port.singleReads == 250);
}

TEST_CASE("an interrupt before the port is asked, while characters come, costs no frame and makes none wrong") {
  // Any Stream; each `available()` may be held up by an interrupt, in which the clock and the line go on.
  struct Delayed : Stream {
    std::minstd_rand random{7};
    uint64_t startUs = fakeMicros;
    size_t bytesRead = 0;

    static uint8_t byteOf(size_t index) { return plainFrame(static_cast<unsigned>(index / 25 % 200))[index % 25]; }
    uint64_t endOf(size_t index) const { return startUs + index / 25 * 9000 + (index % 25 + 1) * 120; }
    int available() override {
      fakeMicros += random() % 2 == 0 ? random() % 1000 : 0;
      int count = 0;
      while (endOf(bytesRead + static_cast<size_t>(count)) <= fakeMicros) {
        count++;
      }
      return count;
    }
    int read() override { return endOf(bytesRead) <= fakeMicros ? byteOf(bytesRead++) : -1; }
    int peek() override { return -1; }
    void flush() override {}
    size_t write(uint8_t) override { return 0; }
  };
  Delayed port;
  DecodeSBus sbus(port);
  sbus.listen();
  SBusFrame frame;
  unsigned frames = 0, wrong = 0;
  while (port.bytesRead < 2000 * 25) {
    fakeMicros += 50;
    if (sbus.read(frame)) {
      const size_t newest = (port.bytesRead - 1) / 25;
      wrong += frame.channels[0] != readBitByBit(plainFrame(static_cast<unsigned>(newest % 200)))[0];
      frames++;
    }
  }
  CHECK(wrong == 0);
  CHECK(frames == 2000);
}
