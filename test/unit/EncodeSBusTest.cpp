// The class EncodeSBus on a fake port of the board's core: what it sends, and when.
#include <doctest/doctest.h>

#include "support/FakeBoard.h"
#include "support/KnownFrames.h"
#include "support/ShowArrays.h"

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

TEST_CASE("begin() opens the port as DecodeSBus does, and sends nothing; end() closes it") {
  FakeSerial port;
  EncodeSBus sbus(port);
  CHECK(port.openings.empty());
  const FakeSerial::Opening rows[] = {{100000, SERIAL_SBUS}, {200000, SERIAL_SBUS}, {200000, SERIAL_8E2}};
  sbus.begin();
  sbus.begin(200000);
  sbus.begin(200000, SERIAL_8E2);
  for (size_t i = 0; i < 3; i++) {
    CHECK(port.openings[i].baud == rows[i].baud);
    CHECK(port.openings[i].config == rows[i].config);
  }
  CHECK(port.written.empty());
  sbus.end();
  CHECK(port.closings == 1);
}

TEST_CASE("the first frame after begin() is sent at once, byte for byte as receivers send these channels and flags") {
  Sender sender;
  for (const KnownFrame &known : {PaperLow, PaperHigh, Neutral}) {
    for (const unsigned flags : {0x00u, 0x04u, 0x08u, 0x0Cu}) {
      INFO(known.source, ", flags ", flags);
      sender.port.written.clear();
      sender.sbus.begin();
      CHECK(sender.write(known.channels, flags >= 0x08, (flags & 0x04) != 0));
      CHECK_FALSE(sender.write(known.channels));
      CHECK(sender.port.written == bytesOf(withByte(known.bytes, 23, flags)));
    }
  }
}

TEST_CASE(
    "called in every loop() it sends once every period; late calls do not add up, also across a wrap of micros()") {
  const struct {
    uint16_t period;
    uint32_t loop;  // us
  } rows[] = {{9000, 50}, {9000, 3000}, {9000, 700}, {4000, 499}, {14000, 5499}, {65535, 1000}};
  for (const auto &row : rows) {
    for (const uint64_t start : {uint64_t{0}, (uint64_t{1} << 32) - 40000}) {
      INFO("period ", row.period, ", loop ", row.loop, ", start ", start);
      fakeMicros = start;
      Sender sender;
      if (row.period != 9000) {  // the default
        sender.sbus.setPeriod(row.period);
      }
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

TEST_CASE("no gap between two frames is shorter than half of what it should be, however late a frame is") {
  const struct {
    uint16_t period;
    uint32_t late;  // us
    uint32_t next;  // us from the late frame to the next
  } rows[] = {{9000, 0, 9000},   {9000, 2999, 6001},    {9000, 3000, 9000},    {9000, 8999, 9000},   {9000, 9000, 9000},
              {4000, 499, 3501}, {4000, 500, 4000},     {14000, 5499, 8501},   {14000, 5500, 14000}, {3000, 1, 3000},
              {2000, 1, 2000},   {65535, 31266, 34269}, {65535, 31267, 65535}, {9000, 191000, 9000}};
  for (const auto &row : rows) {
    INFO("period ", row.period, ", late ", row.late);
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

TEST_CASE(
    "a port gets a frame once it has room for it, or its largest room; a port that reports no room, when it is due") {
  const struct {
    const char *port;
    int most;  // bytes that it takes when its buffer is empty
    int less;  // too little
  } rows[] = {{"STM32L0: 64", 64, 24}, {"25", 25, 24}, {"24", 24, 23}, {"16 bytes of an ATmega8", 15, 14},
              {"arduino-pico: 0 or 1", 1, 0}, {"Uno R4, mbed: always 0", 0, -1}};
  for (const auto &row : rows) {
    CAPTURE(row.port);
    Sender sender;
    sender.port.placesToWrite = row.most;
    CHECK(sender.write(PaperLow.channels));
    fakeMicros += 9000;
    sender.port.placesToWrite = row.less;
    CHECK_FALSE(sender.write(PaperLow.channels));
    CHECK(sender.port.written.size() == 25);
    sender.port.placesToWrite = row.most;
    CHECK(sender.write(PaperLow.channels));
    CHECK(sender.port.written.size() == 50);
    CHECK_FALSE(sender.write(PaperLow.channels));  // it is not time yet
  }
}

TEST_CASE("sending and receiving work at once on one port") {
  SyncedBoard board;
  EncodeSBus encoder(board.port);
  board.nextFrame(PaperHigh.bytes);
  CHECK(encoder.write(PaperLow.channels.data(), false, false));
  CHECK(board.port.written == bytesOf(PaperLow.bytes));
  CHECK(board.channels() == PaperHigh.channels);
  CHECK(board.port.openings.size() == 1);
}

TEST_CASE("EncodeSBus24 sends 24 channels and both flags, every period, and gaps no shorter than half of theirs") {
  for (const unsigned flags : {0x00u, 0x04u, 0x08u, 0x0Cu}) {
    CAPTURE(flags);
    FakeSerial port;
    EncodeSBus24 sbus(port);
    sbus.begin();
    CHECK(sbus.write(Published24.channels.data(), flags >= 0x08, (flags & 0x04) != 0));
    CHECK(port.written == bytesOf(withByte(Published24.bytes, 34, flags)));
  }
  const struct {
    int most;  // bytes that the port takes
    int less;
  } ports[] = {{64, 35}, {36, 35}, {35, 34}};
  for (const auto &row : ports) {
    CAPTURE(row.most);
    FakeSerial port;
    EncodeSBus24 sbus(port);
    sbus.begin();
    port.placesToWrite = row.most;
    CHECK(sbus.write(Published24.channels.data(), false, false));
    fakeMicros += 9000;
    port.placesToWrite = row.less;
    CHECK_FALSE(sbus.write(Published24.channels.data(), false, false));
    port.placesToWrite = row.most;
    CHECK(sbus.write(Published24.channels.data(), false, false));
    CHECK(port.written.size() == 72);
  }
  const uint32_t rows[][3] = {  // period, late, from there to the next: a frame takes 4320 us
      {9000, 0, 9000}, {9000, 2339, 6661}, {9000, 2340, 9000}, {6000, 839, 5161}, {6000, 840, 6000}};
  for (const auto &row : rows) {
    INFO("period ", row[0], ", late ", row[1]);
    fakeMicros = 1000;
    FakeSerial port;
    EncodeSBus24 sbus(port);
    sbus.begin();
    sbus.setPeriod(static_cast<uint16_t>(row[0]));
    CHECK(sbus.write(Published24.channels.data(), false, false));
    fakeMicros += row[0] + row[1];
    CHECK(sbus.write(Published24.channels.data(), false, false));
    fakeMicros += row[2] - 1;
    CHECK_FALSE(sbus.write(Published24.channels.data(), false, false));
    fakeMicros += 1;
    CHECK(sbus.write(Published24.channels.data(), false, false));
  }
}
