// The class EncodeSBus on a fake port of the board's core: what it sends, when, and when not.
#include <doctest/doctest.h>

#include "support/KnownFrames.h"
#include "support/ShowArrays.h"

#include "support/FakeBoard.h"
#include "support/UartPort.h"

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
  board.sbus.begin(200000, SERIAL_8E2);
  sender.sbus.begin(200000, SERIAL_8E2);
  board.sbus.begin(200000);
  sender.sbus.begin(200000);
  REQUIRE(sender.port.openings.size() == 3);
  for (size_t i = 0; i < 3; i++) {
    CHECK(sender.port.openings[i].baud == board.port.openings[i].baud);
    CHECK(sender.port.openings[i].config == board.port.openings[i].config);
  }
  CHECK(sender.port.written.empty());
  sender.sbus.end();
  CHECK(sender.port.closings == 1);
}

TEST_CASE("the first frame is sent at once, byte for byte as a receiver sends these channels") {
  for (const KnownFrame &known : {PaperLow, PaperHigh, Neutral}) {
    CAPTURE(known.source);
    Sender sender;
    CHECK(sender.write(known.channels));
    CHECK(sender.port.written == bytesOf(known.bytes));
  }
}

TEST_CASE("called in every loop(), frames are due every period, and late calls do not add up, across a wrap of micros() too") {
  const struct {
    uint16_t period;
    uint32_t loop;  // us
  } rows[] = {{9000, 50}, {9000, 3000}, {9000, 700}, {4000, 499}, {14000, 5499}, {65535, 1000}};
  for (const auto &row : rows) {
    for (const uint64_t start : {uint64_t{0}, (uint64_t{1} << 32) - 40000}) {
      INFO("period ", row.period, ", loop ", row.loop, ", start ", start);
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
              {2000, 1, 2000},    {65535, 31266, 34269}, {65535, 31267, 65535}, {9000, 191000, 9000}};
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

TEST_CASE("what is sent over a line DecodeSBus reads, every frame with its values and flags, at either baud rate") {
  for (const unsigned long baud : {100000ul, 200000ul}) {
    for (const uint32_t periodUs : {3500u, 7000u, 15000u}) {
      for (const uint32_t loopUs : {50u, 1000u, 2500u}) {
        INFO("baud ", baud, ", periodUs ", periodUs, ", loopUs ", loopUs);
        fakeMicros = MicrosWrap - 50000;
        Sender sender;
        sender.sbus.begin(baud);
        sender.sbus.setPeriod(static_cast<uint16_t>(periodUs));
        UartPort port(baud);
        DecodeSBus decoder(port);
        decoder.begin(baud);
        const uint32_t characterUs = line::LineSettings{baud}.characterUs();
        uint64_t endUs = 0;
        size_t carried = 0;
        uint32_t sent = 0;
        for (unsigned step = 0; sent < 30; step++) {
          Channels channels = PaperHigh.channels;
          channels[0] = static_cast<uint16_t>(sent);
          channels[17] = sent & 1;
          const bool lostFrame = sent % 5 == 0;
          if (sender.write(channels, false, lostFrame)) {
            sent++;
            endUs = std::max(endUs, fakeMicros);
          }
          fakeMicros += 50;
          for (; carried < sender.port.written.size() && endUs + characterUs <= fakeMicros; carried++) {
            endUs += characterUs;
            port.receive({endUs, sender.port.written[carried], false});
          }
          port.advance(fakeMicros);
          if (step % (loopUs / 50) == 0) {
            decoder.parseSBusFrame();
          }
          if (decoder.newFrame() && decoder.counters().frames > 1) {
            Channels read;
            bool failsafe, lost;
            const uint32_t number = decoder.counters().frames - 1;
            decoder.decodeSBusFrame(read.data(), failsafe, lost);
            REQUIRE(read[0] == number);
            REQUIRE(read[17] == (number & 1));
            REQUIRE_FALSE(failsafe);
            REQUIRE(lost == (number % 5 == 0));
          }
        }
        CHECK(decoder.counters().frames + 2 >= sent);
        CHECK(decoder.counters().skippedBytes == 0);
      }
    }
  }
}

TEST_CASE("after begin the first frame is due at once, again") {
  Sender sender;
  CHECK(sender.write(PaperLow.channels));
  CHECK_FALSE(sender.write(PaperLow.channels));
  sender.sbus.begin();
  CHECK(sender.write(PaperLow.channels));
}

TEST_CASE("a port gets a whole frame as soon as it takes one, or as much as it ever takes; one that cannot say, when it is due") {
  const struct {
    const char *port;
    int most;  // bytes that it takes when all has gone out
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

TEST_CASE("on one port both ways work at once") {
  OpenBoard board;
  EncodeSBus encoder(board.port);
  board.nextFrame(PaperHigh.bytes);
  CHECK(encoder.write(PaperLow.channels.data(), false, false));
  CHECK(board.port.written == bytesOf(PaperLow.bytes));
  CHECK(board.channels() == PaperHigh.channels);
  CHECK(board.port.openings.size() == 1);
}
