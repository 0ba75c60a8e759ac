// A board that sleeps: micros() stands still or is slow meanwhile, and millis() is right (support/FakeClock.h). A dead
// line is in failsafe, no age is too small, and no frame is handed out that was received in part before the sleep.
#include <doctest/doctest.h>

#include <climits>

#include <sbus/LinkQuality.h>

#include "support/FakeBoard.h"
#include "support/KnownFrames.h"
#include "support/ListeningBoard.h"
#include "support/ShowArrays.h"
#include "support/TelemetrySketch.h"

using sbus::LinkState;

namespace {

constexpr uint64_t Second = 1000 * Ms;
constexpr uint64_t Hour = 3600 * Second;
constexpr uint64_t Timeout = 100 * Ms;

// An age that millis() shows counts from when the frame was handed over, at up to 3.5 ms less.
constexpr uint64_t Slack = 6 * Ms;

// Checks that all methods agree on a frame that is stale, or not.
template <typename Decoder>
void checkStale(Decoder &decoder, bool isStale) {
  CHECK((decoder.linkState() == LinkState::Stale) == isStale);
  CHECK(decoder.SBusFrameOk() == !isStale);
  bool failsafe, lostFrame;
  Channels channels = Untouched;
  decoder.decodeSBusFrame(channels.data(), failsafe, lostFrame);
  CHECK(failsafe == isStale);
  CHECK((channels == Untouched) == isStale);
  SBusFrame frame;
  decoder.read(frame);
  CHECK(frame.failsafe == isStale);
  CHECK(frame.age == decoder.frameAge());
}

// A board that listens, on a line with a frame each 9 ms.
struct Sleeper : ListeningBoard {
  static constexpr uint64_t PeriodUs = 9 * Ms;
  Sleeper() {
    fakeReset();
    sbus.begin();
    for (unsigned number = 0; number < 5; number++) {
      frame(bytesOf(PaperLow.bytes), PeriodUs);
    }
    REQUIRE(sbus.linkState() == LinkState::Ok);
  }
  void fly(unsigned frames) {
    for (unsigned number = 0; number < frames; number++) {
      frame(bytesOf(PaperLow.bytes), PeriodUs);
    }
  }
};

}  // namespace

TEST_CASE("loop() sleeps: a cut line is in failsafe within the timeout and a loop, and no age is too small") {
  for (const uint64_t sleepUs : {1 * Ms, 3 * Ms, 20 * Ms, 50 * Ms, 150 * Ms}) {
    for (uint64_t phaseUs = 0; phaseUs < 3 * Ms; phaseUs += 170) {
      INFO("sleepUs ", sleepUs, ", phaseUs ", phaseUs);
      fakeMicros = 7 * Second + phaseUs;
      Sleeper board;
      const uint64_t cutUs = fakeMicros - Sleeper::PeriodUs + 25 * 120;
      board.sleep(true);
      unsigned long before = 0;
      bool wasStale = false;
      while (fakeMicros < cutUs + 2 * Second) {
        board.pass(sleepUs);
        SBusFrame frame;
        board.sbus.read(frame);
        const uint64_t age = fakeMicros - cutUs;
        REQUIRE(frame.age * Ms + Ms + Slack > age);
        REQUIRE(frame.age * Ms <= age + 3 * Ms);
        REQUIRE(frame.age >= before);
        REQUIRE((frame.failsafe || age < Timeout + Slack));
        REQUIRE((!frame.failsafe || age + 3 * Ms >= Timeout));
        REQUIRE((frame.failsafe || !wasStale));
        before = frame.age;
        wasStale = frame.failsafe;
      }
      checkStale(board.sbus, true);
    }
  }
}

TEST_CASE("after a deep sleep the first read says failsafe; ages grow from sleep to sleep, and saturate") {
  for (const uint64_t start : {5 * Second, MicrosWrap - 7 * Second, MillisWrap - 7 * Second}) {
    for (const uint64_t sleepUs : {100 * Ms, 5 * Second, 40 * 60 * Second, 73 * 60 * Second, 3 * Hour}) {
      INFO("start ", start, ", sleepUs ", sleepUs);
      fakeMicros = start;
      Sleeper board;
      const uint64_t cutUs = fakeMicros - Sleeper::PeriodUs + 25 * 120;
      unsigned long before = 0;
      for (unsigned round = 0; round < 60; round++) {
        fakeDeepSleep(sleepUs);
        const unsigned long age = board.sbus.frameAge();
        const uint64_t rightMs = std::min<uint64_t>((fakeMicros - cutUs) / Ms, UINT32_MAX / 1000);
        REQUIRE(age >= before);
        REQUIRE(age + 7 >= rightMs);
        REQUIRE(age <= rightMs + 7);
        checkStale(board.sbus, true);
        board.pass(2 * Ms);
        before = age;
      }
    }
  }
}

TEST_CASE("a sleep or a frame in any millisecond before millis() wraps: after a deep sleep the age is right") {
  for (const bool hasSlept : {false, true}) {
    for (uint64_t beforeUs = 0; beforeUs < 250 * Ms; beforeUs += 300) {
      INFO("hasSlept ", hasSlept, ", beforeUs ", beforeUs);
      fakeMicros = MillisWrap - beforeUs;
      Sleeper board;
      if (hasSlept) {
        fakeDeepSleep(60 * Ms);
        board.fly(5);
      }
      const uint64_t cutUs = fakeMicros - Sleeper::PeriodUs + 25 * 120;
      fakeDeepSleep(5 * Second);
      const uint64_t age = board.sbus.frameAge() * Ms;
      REQUIRE(age + 7 * Ms >= fakeMicros - cutUs);
      REQUIRE(age <= fakeMicros - cutUs + 7 * Ms);
      checkStale(board.sbus, true);
    }
  }
}

TEST_CASE("the first frame after 50 ms of sleep may be of before it, or of two: it is stale, and the second is good") {
  for (const uint64_t sleepUs : {60 * Ms, 100 * Ms, 1 * Second, 5 * Second, 40 * 60 * Second}) {
    for (size_t count = 0; count < 25; count++) {
      INFO("sleepUs ", sleepUs, ", count ", count);
      Sleeper board;
      const uint32_t before = board.sbus.counters().frames;
      board.send(part(PaperLow.bytes, 0, count));
      fakeDeepSleep(sleepUs);
      board.send(part(PaperHigh.bytes, count));  // with these, a whole frame has come
      board.pass(5 * Ms);
      // The port tells that the line was idle, except at a half of its ring, or one character before it: that character
      // has come when the call is made. 125 have come before: 3 more fill a half, 19 the next.
      constexpr size_t Whole[] = {0, 2, 3, 18, 19};
      const bool isWhole = std::count(std::begin(Whole), std::end(Whole), count) != 0;
      CHECK(board.sbus.counters().frames == before + isWhole);
      checkStale(board.sbus, isWhole || sleepUs >= Timeout);
      CHECK(board.sbus.frameAge() * Ms + Slack > sleepUs);
      board.frame(bytesOf(PaperHigh.bytes), Sleeper::PeriodUs);
      board.frame(bytesOf(PaperHigh.bytes), Sleeper::PeriodUs);
      checkStale(board.sbus, false);
      CHECK(board.sbus.frameAge() <= 9);
      Channels channels{};
      bool failsafe, lostFrame;
      board.sbus.decodeSBusFrame(channels.data(), failsafe, lostFrame);
      CHECK(channels == PaperHigh.channels);
    }
  }
}

TEST_CASE("millis() adds to an age only what it gains on micros() beyond its own ticks, 2 ms") {
  const struct {
    uint32_t ms, us, ageUs;  // since the frame, by each clock
  } rows[] = {{0, 0, 0},       {1, 0, 0},          {2, 0, 0},          {3, 0, 1000},       {2, 700, 700},
              {3, 1000, 1000}, {52, 50000, 50000}, {53, 50000, 51000}, {60, 10000, 58000}, {0, 1900, 1900}};
  for (const auto &row : rows) {
    INFO(row.ms, " ms, ", row.us, " us");
    sbus::SleepClock clock;
    clock.reset();
    clock.frame(5000, 5);
    CHECK(clock.age(5000, 5000 + row.us, 5 + row.ms) == row.ageUs);
  }
}

TEST_CASE("on a board that is awake, millis() changes no age, whatever its ticks, at any time of both clocks") {
  for (const uint64_t start : {2 * Second, MicrosWrap - 50 * Ms, MillisWrap - 50 * Ms, MillisWrap - 120 * Ms}) {
    for (const unsigned long baud : {100000ul, 200000ul}) {
      for (uint64_t phaseUs = 0; phaseUs < 2 * Ms; phaseUs += 61) {
        INFO("start ", start, ", baud ", baud, ", phaseUs ", phaseUs);
        fakeMicros = start + phaseUs;
        FakeBoard board;
        board.sbus.begin(baud);
        for (unsigned frame = 0; frame < 2; frame++) {
          board.wait(FakeBoard::SilenceUs);
          board.poll(bytesOf(PaperLow.bytes));
        }
        for (unsigned ms = 0; ms < 100; ms++) {
          REQUIRE(board.sbus.frameAge() == ms);
          REQUIRE(board.sbus.linkState() == LinkState::Ok);
          board.wait(1 * Ms);
        }
        REQUIRE(board.sbus.linkState() == LinkState::Stale);
      }
    }
  }
}

TEST_CASE(
    "on a board that is awake, no frame is stale over five hours, with pauses of up to 98 ms, across both wraps") {
  for (const uint64_t start : {MicrosWrap - Hour, MillisWrap - Hour}) {
    fakeMicros = start;
    SyncedBoard board;
    while (fakeMicros < start + 5 * Hour) {
      board.block(fakeMicros % (94 * Ms));
      board.sbus.parseSBusFrame();
      REQUIRE(sbus::isYoung(board.sbus.linkState()));
      board.frame(PaperLow.bytes);
      REQUIRE(sbus::isYoung(board.sbus.linkState()));
      REQUIRE(board.sbus.frameAge() <= 2);
    }
    CHECK(board.sbus.counters().overflows == 0);
  }
}

TEST_CASE("a sensor that was read before a sleep, and does not come after it, is not read after it") {
  for (const uint64_t sleepUs : {100 * Ms, 5 * Second}) {
    CAPTURE(sleepUs);
    fakeReset();
    Sketch sketch(1000);
    sketch.rounds(5);
    REQUIRE(hasVoltage(sketch));
    fakeDeepSleep(sleepUs);
    sketch.loopedUs = fakeMicros;
    sketch.nextUs = fakeMicros + Ms;
    CHECK_FALSE(hasVoltage(sketch));
    Bus silent;
    silent.changeFirst([](std::vector<Answer> &answers) { answers.clear(); });
    for (unsigned round = 0; round < 3; round++) {
      sketch.rounds(1, silent);
      CHECK(sketch.sbus.SBusFrameOk());
      CHECK_FALSE(hasVoltage(sketch));
    }
    sketch.rounds(2);
    CHECK(hasVoltage(sketch));
  }
}

// An AVR's power-down, for example: extras/docs/boards.md. The sketch calls begin() or listen() after waking.
TEST_CASE("if both clocks stand still, a sleep goes unnoticed; after begin() no frame has been seen") {
  SyncedBoard board;
  board.nextFrame(PaperLow.bytes);
  fakeMicros += Hour;
  fakeStoodStillUs += Hour;
  CHECK(board.sbus.linkState() == LinkState::Ok);
  CHECK(board.sbus.frameAge() == 0);
  board.sbus.begin();
  CHECK(board.sbus.linkState() == LinkState::NeverSeen);
  CHECK(board.sbus.frameAge() == ULONG_MAX);
  fakeStoodStillUs = 0;
}
