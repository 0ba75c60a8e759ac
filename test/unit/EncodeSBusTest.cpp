// The class EncodeSBus on a fake port of the board's core: what it sends, and when.
#include <doctest/doctest.h>

#include <algorithm>

#include "support/FakeBoard.h"
#include "support/KnownFrames.h"
#include "support/ShowArrays.h"

#include <EncodeSBus.h>

namespace {

template <typename Encoder, typename Known>
struct SenderOf {
  FakeSerial port;
  Encoder sbus{port};
  const Known &known;

  explicit SenderOf(const Known &frame) : known(frame) { sbus.begin(); }

  bool write(bool failsafe = false, bool lostFrame = false) {
    return sbus.write(known.channels.data(), failsafe, lostFrame);
  }
};
struct Sender : SenderOf<EncodeSBus, KnownFrame> {
  explicit Sender(const KnownFrame &frame = PaperLow) : SenderOf(frame) {}
};
struct Sender24 : SenderOf<EncodeSBus24, KnownLongFrame> {
  Sender24() : SenderOf(Published24) {}
};

struct Room {
  const char *port;
  int most;  // bytes that it takes when its buffer is empty
  int less;  // too little
};
template <typename Sender>
void checkRoom(const Room &row) {
  CAPTURE(row.port);
  Sender sender;
  const size_t size = sender.known.bytes.size();
  sender.port.placesToWrite = row.most;
  CHECK(sender.write());
  fakeMicros += 9000;
  sender.port.placesToWrite = row.less;
  CHECK_FALSE(sender.write());
  CHECK(sender.port.written.size() == size);
  sender.port.placesToWrite = row.most;
  CHECK(sender.write());
  CHECK(sender.port.written.size() == 2 * size);
  CHECK_FALSE(sender.write());  // it is not time yet
}

struct Late {
  uint16_t period;
  uint32_t late;  // us
  uint32_t next;  // us from the late frame to the next
};
template <typename Sender>
void checkGap(const Late &row) {
  INFO("period ", row.period, ", late ", row.late);
  fakeMicros = 1000;
  Sender sender;
  sender.sbus.setPeriod(row.period);
  CHECK(sender.write());
  fakeMicros += row.period + row.late;
  CHECK(sender.write());
  fakeMicros += row.next - 1;
  CHECK_FALSE(sender.write());
  fakeMicros += 1;
  CHECK(sender.write());
}

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
  const auto check = [](auto &&sender, size_t flagsAt, unsigned flags) {
    INFO("flagsAt ", flagsAt, ", flags ", flags);
    CHECK(sender.write(flags >= 0x08, (flags & 0x04) != 0));
    CHECK_FALSE(sender.write());
    CHECK(sender.port.written == bytesOf(withByte(sender.known.bytes, flagsAt, flags)));
  };
  for (const unsigned flags : {0x00u, 0x04u, 0x08u, 0x0Cu}) {
    for (const KnownFrame &known : {PaperLow, PaperHigh, Neutral}) {
      check(Sender(known), 23, flags);
    }
    check(Sender24(), 34, flags);
  }
}

TEST_CASE(
    "called in every loop() it sends once every period; late calls do not add up, also across a wrap of micros()") {
  const struct {
    unsigned long set;
    uint16_t period;  // us
    uint32_t loop;    // us
  } rows[] = {{9000, 9000, 50},     {9000, 9000, 3000},   {9000, 9000, 700},    {4000, 4000, 499},
              {14000, 14000, 5499}, {65535, 65535, 1000}, {100000, 65535, 1000}};
  for (const auto &row : rows) {
    for (const uint64_t start : {uint64_t{0}, (uint64_t{1} << 32) - 40000}) {
      INFO("period ", row.period, ", loop ", row.loop, ", start ", start);
      fakeMicros = start;
      Sender sender;
      if (row.period != 9000) {  // the default
        sender.sbus.setPeriod(row.set);
      }
      unsigned sent = 0;
      for (uint64_t us = 0; us < 100 * uint64_t{row.period}; us += row.loop) {
        fakeMicros = start + us;
        const bool due = us >= sent * uint64_t{row.period};
        REQUIRE(sender.write() == due);
        sent += due;
      }
      CHECK(sent == 100);
      CHECK(sender.port.written.size() == 2500);
    }
  }
}

TEST_CASE("no gap between two frames is shorter than half of what it should be, however late a frame is") {
  const Late rows[] = {{9000, 0, 9000},       {9000, 2999, 6001},  {9000, 3000, 9000}, {9000, 8999, 9000},
                       {9000, 9000, 9000},    {4000, 499, 3501},   {4000, 500, 4000},  {14000, 5499, 8501},
                       {14000, 5500, 14000},  {3000, 1, 3000},     {2000, 1, 2000},    {65535, 31266, 34269},
                       {65535, 31267, 65535}, {9000, 191000, 9000}};
  std::for_each(std::begin(rows), std::end(rows), checkGap<Sender>);
  const Late rows24[] = {{9000, 0, 9000}, {9000, 2339, 6661}, {9000, 2340, 9000}, {6000, 839, 5161}, {6000, 840, 6000}};
  std::for_each(std::begin(rows24), std::end(rows24), checkGap<Sender24>);  // a frame takes 4320 us
}

TEST_CASE(
    "a port gets a frame once it has room for it, or its largest room; a port that reports no room, when it is due") {
  const Room rows[] = {{"STM32L0: 64", 64, 24},
                       {"25", 25, 24},
                       {"24", 24, 23},
                       {"16 bytes of an ATmega8", 15, 14},
                       {"arduino-pico: 0 or 1", 1, 0},
                       {"Uno R4, mbed: always 0", 0, -1}};
  std::for_each(std::begin(rows), std::end(rows), checkRoom<Sender>);
  const Room rows24[] = {{"STM32L0: 64", 64, 35}, {"36", 36, 35}, {"35", 35, 34}};
  std::for_each(std::begin(rows24), std::end(rows24), checkRoom<Sender24>);
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
