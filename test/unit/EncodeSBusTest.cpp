// The class EncodeSBus on a fake port of the board's core: what it sends, when, and when not.
#include <doctest/doctest.h>

#include "support/KnownFrames.h"
#include "support/ShowArrays.h"

// Last: Arduino.h's macros min and max break the standard headers behind it.
#include "support/FakeBoard.h"

#include <EncodeSBus.h>

namespace {

struct Sender {
  FakeSerial port;
  EncodeSBus sbus{port};

  Sender() { sbus.begin(); }

  bool write(const Channels &channels, bool failsafe = false, bool lostFrame = false) {
    return sbus.write(channels.data(), failsafe, lostFrame);
  }
};

}  // namespace

TEST_CASE("begin opens the port as DecodeSBus does, and sends nothing; end closes it") {
  Sender sender;
  FakeBoard board;
  board.sbus.begin();
  REQUIRE(sender.port.openings.size() == 1);
  CHECK(sender.port.openings[0].baud == board.port.openings[0].baud);
  CHECK(sender.port.openings[0].config == board.port.openings[0].config);
  CHECK(sender.port.written.empty());
  sender.sbus.end();
  CHECK(sender.port.closings == 1);
  sender.sbus.begin(200000, SERIAL_8E2);
  CHECK(sender.port.openings[1].baud == 200000);
  CHECK(sender.port.openings[1].config == SERIAL_8E2);
  sender.sbus.begin(200000);
  CHECK(sender.port.openings[2].baud == 200000);
  CHECK(sender.port.openings[2].config == SERIAL_SBUS);
}

TEST_CASE("the first frame is sent at once, byte for byte as a receiver sends these channels") {
  for (const KnownFrame &known : {PaperLow, PaperHigh, Neutral}) {
    CAPTURE(known.source);
    Sender sender;
    CHECK(sender.write(known.channels));
    CHECK(sender.port.written == bytesOf(known.bytes));
  }
}

TEST_CASE("what is sent is what DecodeSBus reads, flags included") {
  for (unsigned flags = 0; flags < 16; flags++) {
    CAPTURE(flags);
    Channels channels = PaperHigh.channels;
    channels[16] = flags & 1;
    channels[17] = flags >> 1 & 1;
    Sender sender;
    CHECK(sender.write(channels, (flags & 8) != 0, (flags & 4) != 0));
    OpenBoard board;
    board.take(sender.port.written + Bytes{0x0F});  // the first frame waits for what follows it
    const Decoded decoded = board.decode();
    CHECK(decoded.channels == channels);
    CHECK(decoded.failsafe == ((flags & 8) != 0));
    CHECK(decoded.lostFrame == ((flags & 4) != 0));
  }
}

TEST_CASE("called in every loop(), frames are due every period, and late calls do not add up, across a wrap of micros() too") {
  const struct {
    uint16_t period;
    uint32_t loop;  // us
  } rows[] = {{9000, 50}, {9000, 3000}, {9000, 700}, {4000, 499}, {14000, 5499}, {65535, 1000}};
  for (const auto &row : rows) {
    for (const uint64_t start : {uint64_t{0}, (uint64_t{1} << 32) - 40000}) {
      CAPTURE(row.period);
      CAPTURE(row.loop);
      CAPTURE(start);
      fakeMicros = start;
      Sender sender;
      sender.sbus.setPeriod(row.period);
      unsigned sent = 0;
      for (uint64_t us = 0; us < 100 * uint64_t{row.period}; us += row.loop) {
        fakeMicros = start + us;
        const bool due = us >= sent * uint64_t{row.period};
        REQUIRE(sender.write(PaperLow.channels) == due);
        sent += due;
      }
      CHECK(sent == 100);
      CHECK(sender.port.written.size() == 2500);
    }
  }
}

TEST_CASE("no pause between two frames becomes shorter than half of what it should be, however late one is") {
  const struct {
    uint16_t period;
    uint32_t late;   // us
    uint32_t next;  // us from the late frame to the next
  } rows[] = {{9000, 0, 9000},    {9000, 2999, 6001}, {9000, 3000, 9000}, {9000, 8999, 9000}, {9000, 9000, 9000},
              {4000, 499, 3501},  {4000, 500, 4000},  {14000, 5499, 8501}, {14000, 5500, 14000}, {3000, 1, 3000},
              {2000, 1, 2000},    {65535, 31266, 34269}, {65535, 31267, 65535}};
  for (const auto &row : rows) {
    CAPTURE(row.period);
    CAPTURE(row.late);
    fakeMicros = 1000;
    Sender sender;
    sender.sbus.setPeriod(row.period);
    CHECK(sender.write(PaperLow.channels));
    fakeMicros += row.period + row.late;
    CHECK(sender.write(PaperLow.channels));
    fakeMicros += row.next - 1;
    CHECK_FALSE(sender.write(PaperLow.channels));
    fakeMicros += 1;
    CHECK(sender.write(PaperLow.channels));
  }
}

TEST_CASE("after a loop() that blocked for longer the next frame is due a period after the late one, and none is made up") {
  fakeMicros = 0;
  Sender sender;
  CHECK(sender.write(PaperLow.channels));
  fakeMicros = 200000;
  CHECK(sender.write(PaperLow.channels));
  fakeMicros = 208999;
  CHECK_FALSE(sender.write(PaperLow.channels));
  fakeMicros = 209000;
  CHECK(sender.write(PaperLow.channels));
}

TEST_CASE("a transmit buffer that does not take a whole frame gets no part of one, and the frame as soon as it does") {
  Sender sender;
  for (const int places : {0, 1, 24}) {
    sender.port.placesToWrite = places;
    CHECK_FALSE(sender.write(PaperLow.channels));
    CHECK(sender.port.written.empty());
  }
  sender.port.placesToWrite = 25;
  CHECK(sender.write(PaperLow.channels));
  CHECK(sender.port.written.size() == 25);
}

TEST_CASE("values out of range are sent as the nearest that there is") {
  Channels channels{};
  channels[0] = 2048;
  channels[1] = UINT16_MAX;
  channels[16] = 2;
  channels[17] = UINT16_MAX;
  Sender sender;
  sender.write(channels);
  OpenBoard board;
  board.take(sender.port.written + Bytes{0x0F});
  const Channels read = board.channels();
  CHECK(read[0] == 2047);
  CHECK(read[1] == 2047);
  CHECK(read[16] == 1);
  CHECK(read[17] == 1);
}

TEST_CASE("on one port both ways work at once") {
  OpenBoard board;
  EncodeSBus encoder(board.port);
  board.nextFrame(PaperHigh.bytes);
  CHECK(encoder.write(PaperLow.channels.data(), false, false));
  CHECK(board.port.written == bytesOf(PaperLow.bytes));
  CHECK(board.channels() == PaperHigh.channels);
  CHECK(board.port.openings.size() == 1);
}
