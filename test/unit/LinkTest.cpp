// May the numbers still be trusted? The link through DecodeSBus: states, timeout, age.
#include <doctest/doctest.h>

#include <climits>

#include "LinkChecks.h"

TEST_CASE("a frame is good for as long as the timeout, and not a millisecond longer") {
  const struct {
    doctest::String what;
    int timeoutMs;  // -1: not set
    uint64_t ageUs;
    bool ok;
  } rows[] = {
      {"default, at once", -1, 0, true},
      {"default, 99 ms", -1, 99 * Ms, true},
      {"default, 100 ms", -1, 100 * Ms, false},
      {"default, an hour", -1, Hour, false},
      {"20, 19 ms", 20, 19 * Ms, true},
      {"20, 20 ms", 20, 20 * Ms, false},
      {"1, at once", 1, 0, true},
      {"1, 1 ms", 1, 1 * Ms, false},
      {"60000, 59 s", 60000, 59 * Second, true},
      {"60000, 60 s", 60000, 60 * Second, false},
      {"0, 1 s", 0, Second, true},
      {"0, 30 hours", 0, 30 * Hour, true},
      {"0, 80 days", 0, 80 * 24 * Hour, true},
  };
  for (const auto &row : rows) {
    CAPTURE(row.what);
    fakeMicros = 5 * Second;
    OpenBoard board;
    if (row.timeoutMs >= 0) {
      board.sbus.setTimeout(static_cast<uint16_t>(row.timeoutMs));
    }
    board.frame(PaperLow.bytes);
    board.wait(row.ageUs);
    checkState(board, row.ok ? LinkState::Ok : LinkState::Stale);
  }
}

TEST_CASE("the timeout can be set before begin, and begin keeps it") {
  FakeBoard board;
  board.sbus.setTimeout(20);
  board.sbus.begin();
  board.frame(PaperLow.bytes);
  board.wait(30 * Ms);
  CHECK_FALSE(board.sbus.SBusFrameOk());
}

TEST_CASE("never seen, ok, lossy, failsafe, stale: each by what comes") {
  const struct {
    doctest::String what;
    std::vector<uint8_t> flags;  // of the frames that come, 10 ms apart
    LinkState state;
  } rows[] = {
      {"nothing", {}, LinkState::NeverSeen},
      {"a frame", {0}, LinkState::Ok},
      {"a frame with CH17 and CH18", {3}, LinkState::Ok},
      {"a lost frame", {Lost}, LinkState::Lossy},
      {"a lost frame behind a good one", {0, Lost}, LinkState::Lossy},
      {"a good frame behind a lost one", {Lost, 0}, LinkState::Ok},
      {"failsafe", {Failsafe}, LinkState::Failsafe},
      {"failsafe and lost", {Lost | Failsafe}, LinkState::Failsafe},
      {"a good frame behind failsafe", {Lost | Failsafe, 0}, LinkState::Ok},
      {"a lost frame behind failsafe", {Failsafe, Lost}, LinkState::Lossy},
  };
  for (const auto &row : rows) {
    CAPTURE(row.what);
    OpenBoard board;
    for (const uint8_t flags : row.flags) {
      board.wait(7 * Ms);
      board.frame(withFlags(flags));
    }
    checkState(board, row.state);
    board.wait(100 * Ms);
    checkState(board, row.state == LinkState::NeverSeen ? LinkState::NeverSeen : LinkState::Stale);
  }
}

TEST_CASE("lossy turns into failsafe after as many lost frames in a row as the limit says, and a good one ends it") {
  for (const unsigned limit : {1u, 2u, 30u, 100u, 300u}) {
    CAPTURE(limit);
    OpenBoard board;
    board.sbus.setTimeout(0);
    if (limit != 100) {  // the default
      board.sbus.setLossLimit(static_cast<uint16_t>(limit));
    }
    for (unsigned round = 0; round < 2; round++) {
      for (unsigned lost = 1; lost <= limit + 5; lost++) {
        CAPTURE(lost);
        board.wait(7 * Ms);
        board.frame(withFlags(Lost));
        REQUIRE(board.sbus.linkState() == (lost < limit ? LinkState::Lossy : LinkState::Failsafe));
        const Decoded decoded = board.decode();
        REQUIRE(decoded.failsafe == (lost >= limit));
        REQUIRE(decoded.lostFrame);
        REQUIRE(decoded.channels == PaperLow.channels);
      }
      board.wait(7 * Ms);
      board.frame(withFlags(0));
      checkState(board, LinkState::Ok);
    }
  }
}

TEST_CASE("with a loss limit of 0 no number of lost frames is a failsafe") {
  OpenBoard board;
  board.sbus.setLossLimit(0);
  for (unsigned lost = 0; lost < 70000; lost++) {
    board.wait(4 * Ms);
    board.frame(withFlags(Lost));
  }
  checkState(board, LinkState::Lossy);
}

TEST_CASE("more lost frames than a counter of 16 bits holds are still a failsafe") {
  OpenBoard board;
  for (unsigned lost = 0; lost < 65536 + 50; lost++) {
    board.wait(4 * Ms);
    board.frame(withFlags(Lost));
  }
  checkState(board, LinkState::Failsafe);
}

TEST_CASE("behind a stale link the first frame makes it ok again, and the second, too") {
  OpenBoard board;
  board.frame(PaperLow.bytes);
  for (const uint64_t silence : {100 * Ms, Second, Hour}) {
    board.wait(silence);
    checkState(board, LinkState::Stale);
    checkState(board, LinkState::Stale);
    for (unsigned frame = 0; frame < 2; frame++) {
      board.frame(PaperHigh.bytes);
      checkState(board, LinkState::Ok);
      board.wait(7 * Ms);
      checkState(board, LinkState::Ok);
    }
  }
}

TEST_CASE("decoding a stale link leaves the channels' last values") {
  OpenBoard board;
  board.frame(PaperHigh.bytes);
  const Decoded good = board.decode();
  board.wait(100 * Ms);
  const Decoded stale = board.decode(good.channels);
  CHECK(stale.channels == PaperHigh.channels);
  CHECK(stale.failsafe);
  CHECK(stale.lostFrame);
}

TEST_CASE("newFrame is true from a frame's coming until it is decoded") {
  OpenBoard board;
  CHECK_FALSE(board.sbus.newFrame());
  board.decode();
  CHECK_FALSE(board.sbus.newFrame());
  for (unsigned round = 0; round < 3; round++) {
    board.frame(PaperLow.bytes);
    CHECK(board.sbus.newFrame());
    CHECK(board.sbus.newFrame());
    board.decode();
    CHECK_FALSE(board.sbus.newFrame());
    board.take({});
    CHECK_FALSE(board.sbus.newFrame());
    board.frame(PaperLow.bytes);
    board.frame(PaperHigh.bytes);
    CHECK(board.sbus.newFrame());
    CHECK(board.channels() == PaperHigh.channels);
    CHECK_FALSE(board.sbus.newFrame());
  }
  board.frame(PaperLow.bytes);
  board.sbus.begin();
  CHECK_FALSE(board.sbus.newFrame());
}

TEST_CASE("frameAge is ULONG_MAX before the first frame, then the newest frame's age in whole milliseconds") {
  fakeMicros = 77 * Second;
  OpenBoard board;
  CHECK(board.sbus.frameAge() == ULONG_MAX);
  board.take(part(PaperLow.bytes, 0, 24));
  CHECK(board.sbus.frameAge() == ULONG_MAX);
  board.sbus.begin();
  board.frame(PaperLow.bytes);
  CHECK(board.sbus.frameAge() == 0);
  uint64_t age = 0;
  for (const uint64_t us : {1 * Ms, 5 * Ms, 94 * Ms, 3 * Second, 100 * Second, 50 * 60 * Second}) {
    CAPTURE(us);
    board.wait(us);
    age += us;
    CHECK(board.sbus.frameAge() == age / Ms);
  }
  board.frame(PaperHigh.bytes);
  CHECK(board.sbus.frameAge() == 0);
  board.sbus.begin();
  CHECK(board.sbus.frameAge() == ULONG_MAX);
}

TEST_CASE("counters count by cause through the class, and begin starts them anew") {
  OpenBoard board;
  const auto counters = [&board] { return board.sbus.counters(); };
  CHECK(counters().frames == 0);
  CHECK(counters().period == 0);
  unsigned number = 0;
  const auto next = [&board, &number](uint8_t flags = 0) {
    Frame frame = plainFrame(number++);
    frame[23] = flags;
    board.frame(frame);
    board.wait(6 * Ms);
  };
  for (unsigned i = 0; i < 20; i++) {
    next();
  }
  CHECK(counters().frames == 20);
  CHECK(counters().period > 8900);
  CHECK(counters().period < 9100);
  next(Lost);
  next(Lost | Failsafe);
  next(Failsafe);
  CHECK(counters().lostFrames == 2);
  CHECK(counters().failsafeFrames == 2);
  CHECK(counters().skippedBytes == 0);
  CHECK(counters().resyncs == 0);

  board.take(Bytes{0x0F} + Bytes(23, 0x20) + Bytes{0x55});
  board.wait(6 * Ms);
  next();
  CHECK(counters().refusedByEnd == 1);
  CHECK(counters().skippedBytes == 25);
  CHECK(counters().resyncs == 1);
  board.take(Bytes{0x0F} + Bytes(22, 0x20) + Bytes{0x10, 0x00});
  board.wait(6 * Ms);
  next();
  CHECK(counters().refusedByFlags == 1);
  board.take(Bytes{0x0F} + Bytes(21, 0x20) + Bytes{0x0C, 0x0C, 0x00, 0x00});
  board.wait(6 * Ms);
  next();
  CHECK(counters().refusedByExtra == 1);
  CHECK(counters().overflows == 0);
  CHECK(counters().frames == 26);

  board.take(Bytes(64, 0xA5));
  CHECK(counters().overflows == 1);
  board.take(Bytes(62, 0xA5));
  CHECK(counters().overflows == 1);

  board.sbus.begin();
  const sbus::Counters none = counters();
  CHECK(none.frames == 0);
  CHECK(none.lostFrames == 0);
  CHECK(none.failsafeFrames == 0);
  CHECK(none.refusedByEnd == 0);
  CHECK(none.refusedByFlags == 0);
  CHECK(none.refusedByExtra == 0);
  CHECK(none.skippedBytes == 0);
  CHECK(none.resyncs == 0);
  CHECK(none.overflows == 0);
  CHECK(none.period == 0);
}

TEST_CASE("end keeps the last frame until it is stale; begin forgets frames, losses and what was stale") {
  OpenBoard board;
  board.sbus.setLossLimit(2);
  board.frame(withFlags(Lost));
  board.sbus.end();
  checkState(board, LinkState::Lossy);
  board.wait(100 * Ms);
  checkState(board, LinkState::Stale);
  board.sbus.begin();
  checkState(board, LinkState::NeverSeen);
  board.frame(withFlags(Lost));
  checkState(board, LinkState::Lossy);  // the first since begin
  board.frame(withFlags(Lost));
  checkState(board, LinkState::Failsafe);
}
