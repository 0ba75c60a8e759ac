// Whether the channels may still be trusted: DecodeSBus's link states, timeout and age, also where clocks wrap
// (micros() after 71 minutes, millis() after 49 days).
#include <doctest/doctest.h>

#include <algorithm>
#include <climits>

#include "support/FakeBoard.h"
#include "support/KnownFrames.h"
#include "support/ShowArrays.h"

using sbus::LinkState;

namespace {

constexpr uint64_t Second = 1000 * Ms;
constexpr uint64_t Hour = 3600 * Second;

constexpr uint8_t Lost = sbus::FlagLostFrame;
constexpr uint8_t Failsafe = sbus::FlagFailsafe;

Frame withFlags(uint8_t flags) { return withByte(PaperLow.bytes, 23, flags); }

// What a sketch is told in each state, and whether channels come with it.
const struct {
  LinkState state;
  bool isOk, hasChannels, failsafe;
} Told[] = {{LinkState::NeverSeen, false, false, true},
            {LinkState::Ok, true, true, false},
            {LinkState::Lossy, true, true, false},
            {LinkState::Failsafe, true, true, true},
            {LinkState::Stale, false, false, true}};

// Checks that the class reports this state, and decodes channels only if they may be trusted.
void checkState(FakeBoard &board, LinkState state) {
  const auto &told =
      *std::find_if(std::begin(Told), std::end(Told), [=](const auto &row) { return row.state == state; });
  CHECK(board.sbus.linkState() == state);
  CHECK(board.sbus.SBusFrameOk() == told.isOk);
  const Decoded decoded = board.decode();
  CHECK((decoded.channels != Untouched) == told.hasChannels);
  CHECK(decoded.failsafe == told.failsafe);
  if (!told.hasChannels) {
    CHECK_FALSE(board.sbus.newFrame());
    CHECK(decoded.lostFrame);
  }
}

}  // namespace

TEST_CASE("a frame is valid for the timeout, and not a millisecond longer, at any baud rate, across any wrap") {
  const struct {
    int timeoutMs;    // -1: not set, 100
    uint64_t goodMs;  // and stale a millisecond later, unless the timeout is 0
  } rows[] = {{-1, 99}, {1, 0}, {20, 19}, {65535, 65534}, {70000, 65534}, {0, 80 * 24 * Hour / Ms}};
  for (const auto &row : rows) {
    for (const uint64_t start : {5 * Second, MicrosWrap - 50 * Ms, MillisWrap - 50 * Ms}) {
      for (const unsigned long baud : {100000ul, 200000ul}) {
        INFO("timeoutMs ", row.timeoutMs, ", start ", start, ", baud ", baud);
        fakeMicros = start;
        FakeBoard board;
        if (row.timeoutMs >= 0) {
          board.sbus.setTimeout(static_cast<unsigned long>(row.timeoutMs));
        }
        board.sbus.begin(baud);
        CHECK(board.sbus.frameAge() == ULONG_MAX);
        for (unsigned frame = 0; frame < 2; frame++) {  // the first one waits for silence
          board.wait(FakeBoard::SilenceUs);
          board.poll(bytesOf(PaperLow.bytes));
        }
        checkState(board, LinkState::Ok);
        board.wait(row.goodMs * Ms);
        checkState(board, LinkState::Ok);
        CHECK((row.timeoutMs == 0 || board.sbus.frameAge() == row.goodMs));
        board.wait(1 * Ms);
        checkState(board, row.timeoutMs == 0 ? LinkState::Ok : LinkState::Stale);
      }
    }
  }
}

TEST_CASE("the frames that come make the link never seen, ok, lossy, failsafe or stale") {
  const struct {
    const char *what;
    std::vector<uint8_t> flags;  // of the frames that come, 9 ms apart
    LinkState state;             // with a loss limit of 2
  } rows[] = {
      {"nothing", {}, LinkState::NeverSeen},
      {"a frame", {0}, LinkState::Ok},
      {"a frame with CH17 and CH18", {3}, LinkState::Ok},
      {"a lost frame before any other: its flags may be an end byte", {Lost}, LinkState::NeverSeen},
      {"a lost frame after a good one", {0, Lost}, LinkState::Lossy},
      {"a good frame after a lost one", {0, Lost, 0}, LinkState::Ok},
      {"two lost frames", {0, Lost, Lost}, LinkState::Failsafe},
      {"a good one between two lost frames", {0, Lost, 0, Lost}, LinkState::Lossy},
      {"failsafe", {Failsafe}, LinkState::Failsafe},
      {"failsafe and lost", {Lost | Failsafe}, LinkState::Failsafe},
      {"a good frame after failsafe", {Lost | Failsafe, 0}, LinkState::Ok},
      {"a lost frame after failsafe", {Failsafe, Lost}, LinkState::Lossy},
      {"failsafe, but not lost, between two lost frames", {0, Lost, Failsafe, Lost}, LinkState::Lossy},
  };
  for (const auto &row : rows) {
    CAPTURE(row.what);
    OpenBoard board;
    board.sbus.setLossLimit(2);
    for (const uint8_t flags : row.flags) {
      board.nextFrame(withFlags(flags));
    }
    board.wait(FakeBoard::SilenceUs);  // proves the first frame
    checkState(board, row.state);
    board.wait(100 * Ms);
    checkState(board, row.state == LinkState::NeverSeen ? LinkState::NeverSeen : LinkState::Stale);
  }
}

TEST_CASE("lossy turns into failsafe after as many lost frames in a row as the limit says; a limit of 0 disables it") {
  const struct {
    int limit;      // -1: not set
    unsigned last;  // lost frame that is lossy
  } rows[] = {{-1, 99}, {1, 0}, {2, 1}, {300, 299}, {65535, 65534}, {0, 65600}};
  for (const auto &row : rows) {
    CAPTURE(row.limit);
    SyncedBoard board;
    if (row.limit >= 0) {
      board.sbus.setLossLimit(static_cast<uint16_t>(row.limit));
    }
    for (unsigned lost = 1; lost <= (row.last > 1000 ? 65600 : row.last + 50); lost++) {
      CAPTURE(lost);
      board.nextFrame(withFlags(Lost));
      const Decoded decoded = board.decode();
      REQUIRE(board.sbus.linkState() == (lost <= row.last ? LinkState::Lossy : LinkState::Failsafe));
      REQUIRE(decoded.failsafe == (lost > row.last));
      REQUIRE(decoded.lostFrame);
      REQUIRE(decoded.channels == PaperLow.channels);
    }
    board.nextFrame(withFlags(0));
    checkState(board, LinkState::Ok);
  }
}

TEST_CASE("newFrame() is true from when a frame comes until it is decoded, stale or forgotten") {
  SyncedBoard board;
  CHECK(board.sbus.newFrame());
  board.decode();
  CHECK_FALSE(board.sbus.newFrame());
  for (unsigned round = 0; round < 3; round++) {
    for (const KnownFrame &known : {PaperLow, PaperHigh}) {
      board.nextFrame(known.bytes);
      CHECK(board.sbus.newFrame());
    }
    CHECK(board.channels() == PaperHigh.channels);
    board.take({});
    CHECK_FALSE(board.sbus.newFrame());
  }
  board.nextFrame(PaperLow.bytes);
  board.wait(99 * Ms);
  CHECK(board.sbus.newFrame());
  board.wait(1 * Ms);
  CHECK_FALSE(board.sbus.newFrame());
  for (unsigned round = 0; round < 2; round++) {
    board.sbus.begin();
    CHECK_FALSE(board.sbus.newFrame());
    board.firstFrame(PaperLow.bytes);  // frame 1 again
    CHECK(board.sbus.newFrame());
    board.decode();
  }
}

TEST_CASE(
    "frameAge() grows until micros() wraps, and then stays; a frame that comes a whole number of wraps later is "
    "young") {
  constexpr unsigned long Oldest = UINT32_MAX / 1000;  // ms
  for (const uint64_t asked : {Second, 20 * 60 * Second, Hour}) {
    for (const uint64_t start : {3 * Second, MicrosWrap - 10 * Ms, MillisWrap - 10 * Ms}) {
      INFO("asked ", asked, ", start ", start);
      fakeMicros = start;
      SyncedBoard board;
      board.frame(PaperLow.bytes);
      uint64_t us = 0;
      while (us + asked < 8 * MicrosWrap - OpenBoard::FrameUs) {
        us += asked;
        board.wait(asked);
        REQUIRE(board.sbus.frameAge() == (us < MicrosWrap ? us / Ms : Oldest));
        REQUIRE(board.sbus.linkState() == LinkState::Stale);
      }
      board.wait(8 * MicrosWrap - OpenBoard::FrameUs - us);
      board.frame(PaperHigh.bytes);
      checkState(board, LinkState::Ok);
      CHECK(board.sbus.frameAge() == 0);
      board.wait(50 * Ms);
      CHECK(board.sbus.frameAge() == 50);
    }
  }
}

TEST_CASE("a frame as old as the timeout is stale, and not a microsecond younger") {
  sbus::Link link;
  link.frame(0);
  for (const uint16_t ms : {uint16_t{1}, uint16_t{100}, uint16_t{65535}}) {
    link.setTimeout(ms);
    CHECK(link.state(ms * 1000u) == LinkState::Stale);
    CHECK(link.state(ms * 1000u - 1) == LinkState::Ok);
  }
}

// On a core without SleepClock nothing else notices the wrap.
TEST_CASE("a Link that is asked once an hour saturates when micros() wraps, and stays so until the next frame") {
  for (const uint64_t asked : {Second, 20 * 60 * Second, Hour}) {
    sbus::Link link;
    link.frame(0);
    for (uint64_t us = asked; us < 8 * MicrosWrap; us += asked) {
      CAPTURE(us);
      REQUIRE(link.age(static_cast<uint32_t>(us)) == (us < MicrosWrap ? us : UINT32_MAX));
      REQUIRE(link.state(5, static_cast<uint32_t>(us + 5)) == (us < 100 * Ms ? LinkState::Ok : LinkState::Stale));
    }
    link.frame(0);
    CHECK(link.age(7) == 7);
    CHECK(link.state(7) == LinkState::Ok);
    link.makeOld();
    CHECK(link.age(7) == UINT32_MAX);
    link.frame(0);
    CHECK(link.age(7) == 7);
    link.makeOld();
    link.reset();
    CHECK(link.age(7) == 7);
  }
}

TEST_CASE("end() keeps the last frame until it is stale; begin() forgets frames, losses and what was stale") {
  OpenBoard board;
  board.sbus.setLossLimit(2);
  for (unsigned round = 0; round < 2; round++) {
    checkState(board, LinkState::NeverSeen);
    CHECK(board.sbus.frameAge() == ULONG_MAX);
    CHECK(board.sbus.counters().frames + board.sbus.counters().lostFrames == 0);
    board.firstFrame(withFlags(0));
    board.nextFrame(withFlags(Lost));
    board.sbus.end();
    checkState(board, LinkState::Lossy);  // the first since begin
    board.wait(100 * Ms);
    checkState(board, LinkState::Stale);
    board.sbus.begin();
  }
}

// loop() is blocked while the radio fails: the port's buffer is full of frames with the last sticks, or more of them
// came.
TEST_CASE("frames that waited while the loop was blocked are as old as they can be, at whatever size of the buffer") {
  for (const size_t capacity : {64u, 512u}) {
    for (const uint64_t blockedUs : {150 * Ms, 10 * Second}) {
      for (const unsigned frames : {1u, 2u, 5u, 30u}) {  // that came while it was blocked, then the radio died
        INFO("capacity ", capacity, ", blockedUs ", blockedUs, ", frames ", frames);
        SyncedBoard board(capacity);
        for (unsigned number = 0; number < 5; number++) {
          board.nextFrame(PaperLow.bytes);
        }
        for (unsigned number = 0; number < frames; number++) {
          board.port.arrive(PaperHigh.bytes);
        }
        board.block(blockedUs);
        board.sbus.parseSBusFrame();
        CHECK(board.counted().frames == 5 + std::min<size_t>(frames, capacity / 25));
        checkState(board, LinkState::Stale);
        // The last call before the block had not found its end, which the port may have held back, with what is behind.
        const size_t behind = frames * 25 > capacity ? capacity % 25 : 0;
        CHECK(board.sbus.frameAge() == (blockedUs + (4 + behind * 5) * 120) / Ms);
        board.nextFrame(PaperLow.bytes);
        checkState(board, LinkState::Ok);
        CHECK(board.sbus.frameAge() == 0);
        CHECK(board.channels() == PaperLow.channels);
      }
    }
  }
}

TEST_CASE("DecodeSBusNoPulses takes a frame in which CH1 to CH4 are 0 for a lost one; DecodeSBus returns it") {
  const struct {
    const char *what;
    std::vector<uint16_t> channels;  // CH1.., the others 0
    uint8_t flags;
    LinkState state;  // of DecodeSBusNoPulses after one frame, after three with a loss limit of 3
    LinkState afterThree;
  } rows[] = {
      {"all 0", {}, 0, LinkState::Lossy, LinkState::Failsafe},
      {"all 0, CH17 on", {}, 1, LinkState::Lossy, LinkState::Failsafe},
      {"all 0 and failsafe", {}, Failsafe, LinkState::Failsafe, LinkState::Failsafe},
      {"CH1 is 1", {1}, 0, LinkState::Ok, LinkState::Ok},
      {"CH4 is 1024", {0, 0, 0, 1024}, 0, LinkState::Ok, LinkState::Ok},
      {"CH5 is 1", {0, 0, 0, 0, 1}, 0, LinkState::Lossy, LinkState::Failsafe},
      {"CH5 and CH16",
       {0, 0, 0, 0, 2047, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1024},
       0,
       LinkState::Lossy,
       LinkState::Failsafe},
      {"sticks and failsafe", {992, 992, 172}, Failsafe, LinkState::Failsafe, LinkState::Failsafe},
  };
  for (const auto &row : rows) {
    CAPTURE(row.what);
    Channels values = {};
    std::copy(row.channels.begin(), row.channels.end(), values.begin());
    values[16] = row.flags & 1;
    Frame frame;
    sbus::pack(frame.data(), values.data(), (row.flags & Failsafe) != 0, false);
    FakeBoardOf<DecodeSBusNoPulses, sbus::Frame16NoPulses> board;
    OpenBoard plain;
    board.sbus.begin();
    board.sbus.setLossLimit(3);
    board.wait(FakeBoard::SilenceUs);
    const auto next = [&](const Frame &bytes) {
      plain.nextFrame(bytes);
      board.nextFrame(bytes);
    };
    next(PaperLow.bytes);
    next(PaperLow.bytes);
    REQUIRE(board.decode().channels == PaperLow.channels);
    next(frame);
    const bool isZero = std::all_of(values.begin(), values.begin() + 4, [](uint16_t raw) { return raw == 0; });
    CHECK(board.sbus.linkState() == row.state);
    CHECK(board.decode().lostFrame == isZero);
    CHECK(board.decode().channels == (isZero ? Untouched : values));
    CHECK(plain.decode().channels == values);
    CHECK_FALSE(plain.decode().lostFrame);
    next(frame);
    next(frame);
    CHECK(board.sbus.linkState() == row.afterThree);
    CHECK(board.decode().failsafe == (row.afterThree == LinkState::Failsafe));
    CHECK(board.sbus.counters().lostFrames == (isZero ? 3 : 0));  // for sbus::LinkQuality
    CHECK(plain.sbus.counters().lostFrames == 0);
  }
}
