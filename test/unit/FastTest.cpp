// Fast S.Bus: 200000 baud, from EncodeSBus over a cable and the board's receive path to DecodeSBus, in half the time.
#include <doctest/doctest.h>

#include <climits>

#include "support/Feed.h"
#include "support/KnownFrames.h"
#include "support/ShowArrays.h"

// Last: Arduino.h's macros min and max break the standard headers after it.
#include "support/BoardPort.h"

#include <DecodeSBus.h>
#include <EncodeSBus.h>

namespace {

constexpr unsigned long Fast = 200000;
constexpr unsigned long Slow = 100000;
constexpr uint32_t Loops[] = {50, 1000, 2500};  // us: the last is all that DecodeSBus.h allows at 200000 baud
constexpr uint32_t Step = 50;                   // us: all loops and periods are multiples of it

// What is sent as frame `number`.
struct Values {
  Channels channels{};
  bool failsafe;
  bool lostFrame;

  Values(uint16_t centre, unsigned number) : failsafe(number % 7 == 3), lostFrame(number % 5 == 2) {
    channels.fill(centre);
    channels[0] = static_cast<uint16_t>(centre - 100 + number);
    channels[16] = number % 2;
    channels[17] = number / 2 % 2;
  }
};

// A port with both classes on it: what a board at either end of the cable is.
struct Board {
  BoardPort port;
  DecodeSBus decoder{port};
  EncodeSBus encoder{port};
  unsigned sent = 0;
  uint64_t decoded = 0;
  uint64_t noise = 0;             // bytes that were handed over before the frames
  sbus::Counters before = {};  // what was counted then

  // Sends the next of `count` frames if it is due.
  void send(uint16_t centre, unsigned count) {
    const Values values(centre, sent);
    sent += sent < count && encoder.write(values.channels.data(), values.failsafe, values.lostFrame);
  }

  // The sketch polls. Every frame whose last byte has been handed over is there then, and the newest one is decoded.
  void poll(uint16_t centre) {
    const uint64_t whole = (port.handedOver() - noise) / 25;
    decoder.parseSBusFrame();
    if (whole == 1 && decoder.counters().frames == 0) {
      return;  // the very first may wait for what follows it
    }
    if (decoder.counters().frames != decoded || whole != decoded || decoder.newFrame()) {
      REQUIRE(decoder.counters().frames == whole);
      REQUIRE(decoder.newFrame());
      const Values expected(centre, static_cast<unsigned>(whole) - 1);
      Channels channels{};
      bool failsafe = !expected.failsafe;
      bool lostFrame = !expected.lostFrame;
      decoder.decodeSBusFrame(channels.data(), failsafe, lostFrame);
      REQUIRE(channels == expected.channels);
      REQUIRE(failsafe == expected.failsafe);
      REQUIRE(lostFrame == expected.lostFrame);
      decoded = whole;
    }
  }

  // `count` frames have come, `periodUs` from one to the next, polled every `loopUs`, and nothing else.
  void checkCounters(unsigned count, uint32_t periodUs, uint32_t loopUs) const {
    const sbus::Counters counters = decoder.counters() - before;
    CHECK(counters.frames == count);
    // It is measured from poll to poll. What is smoothed away is rounded down, by 7 us at the most.
    CHECK(counters.period + loopUs + 7 >= periodUs);
    CHECK(counters.period <= periodUs + loopUs);
    CHECK(counters.skippedBytes == 0);
    CHECK(counters.refusedByEnd == 0);
    CHECK(counters.refusedByFlags == 0);
    CHECK(counters.refusedByExtra == 0);
    CHECK(counters.overflows == 0);
    CHECK(counters.resyncs == 0);
  }
};

// Two boards and the cables between them, at a time when both ports are open.
struct TwoBoards {
  Board left;
  Board right;
  Cable toRight{left.port, right.port};
  Cable toLeft{right.port, left.port};

  // On each, one of the two classes opens the port.
  explicit TwoBoards(unsigned long baud, uint64_t startUs = 0) {
    fakeMicros = startUs;
    left.encoder.begin(baud);
    right.decoder.begin(baud);
  }

  void step(uint64_t us = Step) {
    fakeMicros += us;
    toRight.carry();
    toLeft.carry();
  }

  // Polls that find noise: the receivers know how often they are polled.
  void settle(uint32_t loopUs) {
    for (unsigned poll = 0; poll < 8; poll++) {
      for (Board *const board : {&left, &right}) {
        board->port.written.insert(board->port.written.end(), poll < 6, 0x55);
      }
      step(loopUs < 200 ? 200 : loopUs);
      for (Board *const board : {&left, &right}) {
        board->decoder.parseSBusFrame();
        board->noise = board->port.handedOver();
        board->before = board->decoder.counters();
      }
    }
  }
};

// A line without any pause: `count` frames.
void sendSolid(Board &board, uint16_t centre, unsigned count) {
  for (; board.sent < count; board.sent++) {
    const Values values(centre, board.sent);
    Frame frame;
    sbus::pack(frame.data(), values.channels.data(), values.failsafe, values.lostFrame);
    board.port.written.insert(board.port.written.end(), frame.begin(), frame.end());
  }
}

}  // namespace

TEST_CASE("from EncodeSBus to DecodeSBus every frame comes, with its values, at the first poll that can find it") {
  constexpr unsigned Count = 24;
  for (const uint32_t periodUs : {3000u, 3500u, 4000u, 4500u, 6000u, 7000u, 7500u, 9000u, 11000u, 14000u, 15000u}) {
    for (const uint32_t loopUs : Loops) {
      for (const uint16_t centre : {uint16_t{992}, uint16_t{1024}}) {  // with 0F in the payload, and without
        for (const uint64_t start : {uint64_t{0}, MicrosWrap - 50000}) {
          CAPTURE(periodUs);
          CAPTURE(loopUs);
          CAPTURE(centre);
          CAPTURE(start);
          TwoBoards boards(Fast, start);
          boards.left.encoder.setPeriod(static_cast<uint16_t>(periodUs));
          boards.settle(loopUs);
          for (uint64_t us = 0; us < Count * periodUs + 10000; us += Step) {
            boards.left.send(centre, Count);
            boards.step();
            if (us % loopUs == 0) {
              boards.right.poll(centre);
            }
          }
          boards.right.checkCounters(Count, periodUs, loopUs);
        }
      }
    }
  }
}

TEST_CASE("both ways at once on one port, each with its own period, values and loop()") {
  const struct {
    uint32_t toRightUs;  // period
    uint32_t toLeftUs;
    uint32_t loopUs;  // of the right board
  } rows[] = {{3000, 9000, 1000}, {4000, 4000, 50}, {9000, 4500, 2500}, {3500, 3000, 2500}};
  constexpr unsigned Count = 30;
  for (const auto &row : rows) {
    CAPTURE(row.toRightUs);
    CAPTURE(row.toLeftUs);
    CAPTURE(row.loopUs);
    TwoBoards boards(Fast);
    boards.left.decoder.begin(Fast);  // either class opens the port
    boards.right.encoder.setPeriod(static_cast<uint16_t>(row.toLeftUs));
    boards.left.encoder.setPeriod(static_cast<uint16_t>(row.toRightUs));
    boards.settle(row.loopUs);
    for (uint64_t us = 0; us < Count * 9000u + 10000; us += Step) {
      boards.left.send(992, Count);
      boards.left.poll(1024);
      if (us % row.loopUs == 0) {
        boards.right.send(1024, Count);
        boards.right.poll(992);
      }
      boards.step();
    }
    boards.right.checkCounters(Count, row.toRightUs, row.loopUs);
    boards.left.checkCounters(Count, row.toLeftUs, row.loopUs);
  }
}

TEST_CASE("a port that one class opened at the other baud rate hears nothing, and the next begin() mends it") {
  for (const unsigned long wrong : {Slow, Fast}) {
    CAPTURE(wrong);
    TwoBoards boards(wrong);
    boards.left.encoder.begin(Fast + Slow - wrong);
    for (unsigned us = 0; us < 20000; us += Step) {
      boards.left.send(992, 2);
      boards.step();
      boards.right.decoder.parseSBusFrame();
    }
    CHECK(boards.left.sent == 2);
    CHECK(boards.right.decoder.linkState() == sbus::LinkState::NeverSeen);
    boards.right.decoder.begin(Fast + Slow - wrong);
    for (unsigned us = 0; us < 20000; us += Step) {
      boards.left.send(992, 5);
      boards.step();
      boards.right.decoder.parseSBusFrame();
    }
    CHECK(boards.right.decoder.counters().frames >= 1);  // the first may wait for the second
  }
}

TEST_CASE("a frame is good for the timeout, 100 ms unless told, whatever the baud rate; begin(200000) keeps it") {
  const struct {
    int timeoutMs;  // -1: not set
    uint32_t ageMs;
    bool ok;
  } rows[] = {{-1, 0, true}, {-1, 50, true},  {-1, 99, true},   {-1, 100, false},
              {20, 19, true}, {20, 20, false}, {1, 1, false},    {200, 199, true},
              {200, 200, false}, {0, 3600000, true}};
  for (const auto &row : rows) {
    for (const unsigned long baud : {Slow, Fast}) {
      CAPTURE(row.timeoutMs);
      CAPTURE(row.ageMs);
      CAPTURE(baud);
      TwoBoards boards(baud);
      DecodeSBus &decoder = boards.right.decoder;
      if (row.timeoutMs >= 0) {
        decoder.setTimeout(static_cast<uint16_t>(row.timeoutMs));
        decoder.begin(baud);
      }
      boards.settle(Step);
      CHECK(decoder.frameAge() == ULONG_MAX);
      boards.left.send(992, 1);
      for (uint64_t us = 0; us < 20000 && decoder.counters().frames == 0; us += Step) {
        boards.step();
        decoder.parseSBusFrame();
      }
      REQUIRE(decoder.counters().frames == 1);
      boards.step(row.ageMs * uint64_t{1000});
      CHECK(decoder.frameAge() == row.ageMs);
      CHECK(decoder.linkState() == (row.ok ? sbus::LinkState::Ok : sbus::LinkState::Stale));
      CHECK(decoder.SBusFrameOk() == row.ok);
    }
  }
}

// The driver hands over 16 bytes at a time, and a buffer that is found full, 64, may have been full for long: then the
// frame that it ends in is given up. Polls that are 48 characters apart never find it full.
TEST_CASE("a line without pauses is read whole by polls every 5 ms, at 200000 baud 2.5 ms, and 48 characters apart") {
  const struct {
    unsigned long baud;
    uint32_t loopUs;
    bool whole;
  } rows[] = {{Slow, 5000, true}, {Slow, 5760, true}, {Slow, 5900, false}, {Slow, 7680, false},
              {Fast, 2500, true}, {Fast, 2880, true}, {Fast, 2950, false}, {Fast, 3840, false}};
  constexpr unsigned Count = 60;
  for (const auto &row : rows) {
    for (const uint16_t centre : {uint16_t{992}, uint16_t{1024}}) {
      CAPTURE(row.baud);
      CAPTURE(row.loopUs);
      CAPTURE(centre);
      TwoBoards boards(row.baud);
      boards.settle(row.loopUs);
      sendSolid(boards.left, centre, Count);
      boards.step(0);
      for (uint64_t us = 0; us < 60 * 3000 + 10000; us += row.loopUs) {
        boards.step(row.loopUs);
        if (row.whole) {
          boards.right.poll(centre);
        } else {
          boards.right.decoder.parseSBusFrame();
        }
      }
      const sbus::Counters counters = boards.right.decoder.counters();
      CHECK((counters.frames == Count) == row.whole);
      CHECK((counters.overflows == 0) == row.whole);
      // Up to 64 characters apart the buffer takes all; what is lost is lost by caution.
      CHECK(boards.right.port.uart.droppedFull() == 0);
    }
  }
}

TEST_CASE("a frame every 2000 us, the shortest that EncodeSBus.h advises, is found from any place of a frame on") {
  constexpr unsigned Count = 20;
  for (const uint32_t loopUs : Loops) {
    for (unsigned character = 0; character < 33; character++) {
      CAPTURE(loopUs);
      CAPTURE(character);
      TwoBoards boards(Fast);
      boards.left.encoder.setPeriod(2000);
      unsigned before = 0;
      for (uint32_t us = 0; us < Count * 2000 + 10000; us += 20) {
        boards.left.send(992, Count);
        boards.step(20);
        if (us == 4000 + 60 * character) {
          before = boards.left.sent;
          boards.right.decoder.begin(Fast);
        } else if (before != 0 && us % loopUs < 20) {
          boards.right.decoder.parseSBusFrame();
        }
      }
      CHECK(boards.left.sent == Count);
      CHECK(boards.right.decoder.counters().frames + 2 >= Count - before);
    }
  }
}

TEST_CASE("begin(200000) makes a pause within a frame, read byte by byte, one from half as many microseconds on") {
  const struct {
    unsigned long baud;
    uint32_t quietUs;  // between two bytes of the third frame
    bool refused;
  } rows[] = {{Slow, 120, false}, {Slow, 513, false}, {Slow, 514, true}, {Slow, 5000, true},
              {Fast, 60, false},  {Fast, 256, false}, {Fast, 257, true}, {Fast, 2500, true}};
  for (const auto &row : rows) {
    CAPTURE(row.baud);
    CAPTURE(row.quietUs);
    const uint32_t characterUs = line::LineSettings{row.baud}.characterUs();
    fakeMicros = 0;
    FakeSerial port;
    DecodeSBus decoder(port);
    decoder.begin(row.baud);
    for (unsigned noise = 0; noise < 3; noise++) {
      fakeMicros += characterUs;
      port.arrive(Bytes{0x55});
      decoder.parseSBusFrame();
    }
    for (unsigned index = 0; index < 5 * 25; index++) {
      const bool isFirst = index % 25 == 0;
      fakeMicros += index == 2 * 25 + 13 ? row.quietUs : isFirst ? 50 * characterUs : characterUs;
      port.arrive(Bytes{plainFrame(index / 25)[index % 25]});
      decoder.parseSBusFrame();
    }
    CHECK(decoder.counters().frames == (row.refused ? 4 : 5));
    CHECK(decoder.counters().refusedByExtra == row.refused);
  }
}

TEST_CASE("a frame cut by a pause is refused, or not, as with twice the pause and twice the loop() at 100000 baud") {
  const struct {
    uint32_t loop;         // characters
    unsigned cut;          // the pause is in front of this byte
    unsigned refusedFrom;  // half characters of pause
  } rows[] = {{1, 1, 9},  {1, 5, 5},  {1, 13, 9},  {1, 21, 5},   {1, 24, 7},   {4, 13, 13},  {4, 16, 21},
              {8, 1, 21}, {8, 4, 21}, {8, 24, 27}, {16, 21, 43}, {25, 24, 49}, {40, 16, 91}};  // the last: not seen
  for (const auto &row : rows) {
    for (unsigned halves = 0; halves <= 90; halves++) {
      CAPTURE(row.loop);
      CAPTURE(row.cut);
      CAPTURE(halves);
      Frames found[2];
      for (const uint32_t characterUs : {60u, 120u}) {
        FedLine wire(characterUs);
        for (unsigned number = 0; number < 8; number++) {
          const Frame frame = plainFrame(number);
          if (number == 3) {
            wire.send(part(frame, 0, row.cut)).pause(halves * characterUs / 2).send(part(frame, row.cut));
          } else {
            wire.send(frame);
          }
          wire.pause(50 * characterUs);
        }
        found[characterUs == 60] = wire.frames(row.loop * characterUs);
      }
      CHECK(found[1] == found[0]);
      CHECK(found[1].size() == (halves >= row.refusedFrom ? 7 : 8));
    }
  }
}
