// What a poll asks a port for and in which order, what it drops, and what it tells the link: on a port that is no
// core's.
#include "port/PortReader.h"

#include <doctest/doctest.h>

#include <deque>
#include <functional>
#include <utility>

#include "sbus/Link.h"
#include "support/Bytes.h"
#include "support/KnownFrames.h"
#include "support/ShowArrays.h"

namespace {

uint32_t clockUs;

struct FakePort {
  static constexpr bool HasCallback = true, TellsLoss = true;
  bool tellsLoss() const { return false; }
  static uint32_t now() { return clockUs; }

  std::deque<uint8_t> bytes;
  std::function<void()> answered = [] {};  // what comes once available() has answered, once
  std::function<void()> counted = [] {};   // ... once waiting() has
  bool fails = false, lost = false, losesOldest = false, tells = false, idle = false, atHalf = false;
  unsigned overasked = 0, rearmed = 0;

  explicit FakePort(uint32_t &) {}

  void arrive(const Bytes &more) { bytes.insert(bytes.end(), more.begin(), more.end()); }
  int available() {
    const int count = lost ? 1 : static_cast<int>(bytes.size());
    std::exchange(answered, [] {})();
    return count;
  }
  int read(uint8_t *buffer, size_t size) {
    if (std::exchange(lost, false)) {
      return 0;
    }
    overasked += size > bytes.size();
    size_t count = 0;
    for (; !fails && count < size && !bytes.empty(); count++) {
      buffer[count] = bytes.front();
      bytes.pop_front();
    }
    return fails ? -1 : static_cast<int>(count);
  }
  unsigned halfCapacity() const { return 32; }
  bool losesNewest() const { return !losesOldest; }
  bool mayHaveLostOldest(unsigned waiting) const { return losesOldest && waiting > 32; }
  uint8_t idleCharacters(unsigned long) const { return 0; }
  bool tellsIdle() const { return tells; }
  bool wasIdle() const { return idle; }
  bool isIdle() const { return idle && bytes.empty(); }
  bool isAtHalf() const { return atHalf; }
  void rearm() { rearmed++; }
  unsigned waiting() const {
    const unsigned count = static_cast<unsigned>(bytes.size());
    counted();
    return count;
  }
  bool tryLock() {
    wasCalled = isBusy;
    return !std::exchange(isBusy, true);
  }
  bool unlock() {
    isBusy = false;
    return std::exchange(wasCalled, false);
  }
  bool isBusy = false, wasCalled = false;
};

struct FakeLink : sbus::Link {
  bool hasSlept = false;
  unsigned starts = 0;
  void start() { starts++; }
  bool noteFrame(uint32_t) const { return hasSlept; }
};

template <typename Format>
struct ReaderOf : sbus::PortReader<Format, sbus::NoEvents, FakePort, FakeLink> {
  using Base = sbus::PortReader<Format, sbus::NoEvents, FakePort, FakeLink>;
  FakePort &port = Base::_port;
  FakeLink &link = Base::_link;
  sbus::FrameFinderOf<Format> &finder = Base::_finder;

  ReaderOf() : Base(clockUs) { Base::reset(100000); }

  sbus::Counters counters() const { return Base::_finder.counters(); }
  // Polls once `us` have passed.
  void pollAfter(uint32_t us) {
    clockUs += us;
    Base::pollAll(false);
  }
  // Lets the line be silent, with a poll each 50 us.
  void silence(uint32_t us = 6000) {
    for (const uint32_t endUs = clockUs + us; clockUs != endUs;) {
      pollAfter(50);
    }
  }
  void frame(const Bytes &bytes) {
    clockUs += 3000;
    port.arrive(bytes);
    silence();
  }
  void sync() {
    silence();
    for (unsigned number = 0; number < 3; number++) {
      frame(bytesOf(plainFrame(number)));
    }
    REQUIRE(counters().frames == 3);
  }
};

using Reader = ReaderOf<sbus::Frame16>;

}  // namespace

TEST_CASE(
    "a poll reads what waited when it asked, and never asks for more; what comes meanwhile is left for the next") {
  for (size_t held = 0; held < 25; held++) {
    for (size_t found = 1; found <= 32; found++) {
      INFO("held ", held, ", found ", found);
      Reader reader;
      reader.port.arrive(Bytes(held, 0xA5));
      reader.pollAfter(50);
      reader.port.arrive(Bytes(found, 0xA5));
      reader.port.answered = [&] { reader.port.arrive({0x0F, 0x0F}); };
      reader.pollAfter(50);
      CHECK(reader.port.bytes.size() == 2);
      CHECK(reader.port.overasked == 0);
      CHECK(reader.counters().overflows == 0);
    }
  }
}

TEST_CASE("a port whose read() fails ends the poll") {
  Reader reader;
  reader.port.fails = true;
  reader.port.arrive(Bytes(40, 0xA5));
  reader.pollAfter(50);
  CHECK(reader.port.bytes.size() == 40);
}

TEST_CASE("bytes that came after a poll found more than half of the buffer, and may have filled it, are dropped") {
  const struct {
    size_t found, more;
    bool losesOldest, drops;
  } rows[] = {{33, 31, false, false}, {33, 32, false, true},  {64, 0, false, false},
              {64, 1, false, true},   {32, 33, false, false},  // at most half: a poll would have to last 4 ms
              {33, 32, true, false}};                          // it has lost before those that were read
  for (const auto &row : rows) {
    INFO("found ", row.found, ", more ", row.more, ", loses ", row.losesOldest ? "oldest" : "newest");
    Reader reader;
    reader.port.losesOldest = row.losesOldest;
    reader.port.arrive(Bytes(row.found, 0xA5));
    reader.port.answered = [&] { reader.port.arrive(Bytes(row.more, 0xA5)); };
    reader.pollAfter(50);
    CHECK(reader.counters().overflows == (row.drops || row.losesOldest ? 1 : 0));
    CHECK(reader.port.bytes.size() == (row.drops ? 0 : row.more));
  }
}

TEST_CASE("where bytes are lost before those that wait, those that were read before are dropped") {
  for (const bool isPin : {false, true}) {
    CAPTURE(isPin);
    Reader reader;
    reader.sync();
    reader.port.losesOldest = !isPin;
    const Bytes line = bytesOf(plainFrame(3));
    clockUs += 12 * 120;
    reader.port.arrive(part(line, 0, 12));
    reader.pollAfter(0);
    reader.port.lost = isPin;
    reader.port.arrive(part(line, 12) + (isPin ? Bytes{} : join({plainFrame(4)})));
    reader.pollAfter(13 * 120);
    reader.pollAfter(50);
    CHECK(reader.counters().overflows == 1);
    CHECK(reader.counters().frames == (isPin ? 3 : 4));
    CHECK(reader.finder.frame()[1] == plainFrame(isPin ? 2 : 4)[1]);
  }
}

TEST_CASE("a loop() that is stopped once the port has answered makes no frame too young") {
  Reader reader;
  reader.sync();
  const Bytes line = bytesOf(plainFrame(3));
  uint32_t endedUs = 0;
  reader.port.answered = [&] {
    reader.port.arrive(part(line, 16));
    clockUs += 9 * 120;
    endedUs = clockUs;
    clockUs += 6000;
  };
  reader.port.arrive(part(line, 0, 16));
  reader.pollAfter(1920);
  reader.pollAfter(50);
  CHECK(reader.counters().frames == 4);
  CHECK(static_cast<int32_t>(endedUs - reader.finder.frameTime()) >= 0);
}

TEST_CASE("a port that calls back during a poll is polled once more, and not by the call itself") {
  Reader reader;
  reader.sync();
  reader.port.arrive(bytesOf(plainFrame(3)));
  reader.port.answered = [&] {
    reader.port.arrive({0x04, 0x05});
    reader.onReceive();
    CHECK(reader.port.bytes.size() == 27);
  };
  reader.pollAfter(3000);
  CHECK(reader.counters().frames == 4);
  CHECK(reader.port.bytes.empty());
}

TEST_CASE("a port that calls at a half of its ring may call again, and keeps bytes that complete no frame") {
  const struct {
    size_t read, waiting;
    bool isKept;
  } rows[] = {{0, 16, true}, {0, 24, true}, {0, 25, false}, {9, 16, false}, {8, 16, true}};
  for (const auto &row : rows) {
    INFO(row.read, " read, ", row.waiting, " wait");
    Reader reader;
    reader.sync();
    reader.port.tells = true;
    const Bytes line = bytesOf(plainFrame(3)) + bytesOf(plainFrame(4));
    reader.port.arrive(part(line, 0, row.read));
    reader.pollAfter(static_cast<uint32_t>(120 * row.read));
    reader.port.atHalf = true;
    reader.port.counted = [&] { CHECK(reader.port.rearmed == 1); };  // a byte that comes after this calls
    reader.port.arrive(part(line, row.read, row.read + row.waiting));
    clockUs += static_cast<uint32_t>(120 * row.waiting);
    reader.onReceive();
    CHECK(reader.port.rearmed == 1);
    CHECK(reader.port.bytes.size() == (row.isKept ? row.waiting : 0));
  }
}

TEST_CASE("the link learns each frame's flags; a frame is old if the board has slept since the one before it") {
  Reader reader;
  CHECK(reader.link.starts == 1);
  reader.sync();
  CHECK(reader.link.state(0) == sbus::LinkState::Ok);
  Frame frame = plainFrame(3);
  frame[23] = sbus::FlagLostFrame;
  reader.frame(bytesOf(frame));
  CHECK(reader.link.state(0) == sbus::LinkState::Lossy);
  CHECK(reader.link.age(0) == 0);
  reader.link.hasSlept = true;
  reader.frame(bytesOf(plainFrame(4)));
  CHECK(reader.link.state(0) == sbus::LinkState::Ok);
  CHECK(reader.link.age(0) == UINT32_MAX);
}

TEST_CASE("until a frame with channels comes, those that withhold them are failsafe") {
  ReaderOf<sbus::Frame16NoPulses> reader;
  const Frame none = writeBitByBit(Channels{});
  reader.silence();
  for (unsigned i = 0; i < 3; i++) {
    reader.frame(bytesOf(none));
    CHECK(reader.link.isFailsafe() == (reader.counters().frames != 0));
  }
  REQUIRE(reader.counters().lostFrames >= 2);
  reader.frame(bytesOf(plainFrame(0)));
  reader.frame(bytesOf(none));
  CHECK(reader.link.state(0) == sbus::LinkState::Lossy);
}
