// read(): frames as values. What they hold, when they are new, and what they say when no frame comes.
#include <doctest/doctest.h>

#include <algorithm>

#include "support/BitByBit.h"
#include "support/FakeBoard.h"
#include "support/KnownFrames.h"
#include "support/ShowArrays.h"

// After Arduino.h.
#include <DecodeSBusTelemetry.h>
#include <EncodeSBus.h>

namespace {

Channels channelsOf(const SBusFrame &frame) {
  Channels channels;
  std::copy_n(frame.channels, channels.size(), channels.begin());
  return channels;
}

// Compares all that a frame says but its age.
void check(const SBusFrame &frame, const Channels &channels, bool failsafe, bool lostFrame) {
  CHECK(channelsOf(frame) == channels);
  CHECK(frame.ch17() == (channels[16] != 0));
  CHECK(frame.ch18() == (channels[17] != 0));
  CHECK(frame.failsafe == failsafe);
  CHECK(frame.lostFrame == lostFrame);
}

}  // namespace

TEST_CASE("read() polls by itself, and returns each frame once, with its flags, also lost and failsafe frames") {
  OpenBoard board;
  SBusFrame frame;
  board.firstFrame(Neutral.bytes);
  CHECK(board.sbus.read(frame));
  check(frame, Neutral.channels, false, false);
  for (unsigned flags = 0; flags < 16; flags++) {
    CAPTURE(flags);
    const Frame bytes = withByte(PaperHigh.bytes, 23, flags);
    board.wait(6 * Ms);
    board.block(25 * 120);
    board.port.arrive(bytesOf(bytes));
    CHECK(board.sbus.read(frame));
    check(frame, readBitByBit(bytes), (flags & 8) != 0, (flags & 4) != 0);
    CHECK(frame.age < 5);
    CHECK_FALSE(board.sbus.newFrame());
    CHECK_FALSE(board.sbus.read(frame));
    check(frame, readBitByBit(bytes), (flags & 8) != 0, (flags & 4) != 0);
  }
}

TEST_CASE("until a frame comes, and once they stop, a frame says failsafe; its channels stay, and its age grows") {
  OpenBoard board;
  SBusFrame frame;
  const SBusFrame fresh;
  check(fresh, Channels{}, true, true);
  CHECK(fresh.age == ULONG_MAX);
  CHECK_FALSE(board.sbus.read(frame));
  check(frame, Channels{}, true, true);
  CHECK(frame.age == ULONG_MAX);
  board.firstFrame(Neutral.bytes);
  CHECK(board.sbus.read(frame));
  board.take(part(PaperLow.bytes, 0, 24));
  for (unsigned ms = 1; ms < 300; ms++) {
    board.block(1 * Ms);
    CHECK_FALSE(board.sbus.read(frame));
    const bool isStale = board.sbus.linkState() == sbus::LinkState::Stale;
    check(frame, Neutral.channels, isStale, isStale);
    CHECK(frame.age == board.sbus.frameAge());
  }
  CHECK(frame.failsafe);
  CHECK(frame.age >= 299);
  board.sbus.begin();
  CHECK_FALSE(board.sbus.read(frame));
  CHECK(frame.age == ULONG_MAX);
}

TEST_CASE("the other decoders read as well: 24 channels, telemetry") {
  SBusFrame frame;
  FakeBoardOf<DecodeSBusTelemetry, sbus::Frame16> telemetry;
  telemetry.sbus.begin();
  telemetry.firstFrame(PaperLow.bytes);
  CHECK(telemetry.sbus.read(frame));
  check(frame, PaperLow.channels, false, false);

  LongChannels channels = {};
  channels[0] = 172;
  channels[23] = 1234;
  LongFrame bytes;
  sbus::pack24(bytes.data(), channels.data(), false, true);
  FakeBoardOf<DecodeSBus24, sbus::Frame24> board;
  SBusFrame24 long24;
  board.sbus.begin();
  board.firstFrame(bytes);
  CHECK(board.sbus.read(long24));
  CHECK(std::equal(channels.begin(), channels.end(), long24.channels));
  CHECK(long24.lostFrame);
  CHECK_FALSE(long24.failsafe);
}

TEST_CASE("DecodeSBusNoPulses says failsafe until a frame with channels has come, whatever the loss limit") {
  for (const uint16_t limit : {uint16_t{0}, uint16_t{1}, uint16_t{100}}) {
    CAPTURE(limit);
    FakeBoardOf<DecodeSBusNoPulses, sbus::Frame16NoPulses> board;
    SBusFrame frame;
    board.sbus.setLossLimit(limit);
    board.sbus.begin();
    board.firstFrame(writeBitByBit(Channels{}));
    for (int i = 0; i < 3; i++) {
      CHECK(board.sbus.read(frame));
      check(frame, Channels{}, true, true);
      CHECK(board.sbus.linkState() == sbus::LinkState::Failsafe);
      board.nextFrame(writeBitByBit(Channels{}));
    }
    board.nextFrame(PaperHigh.bytes);
    CHECK(board.sbus.read(frame));
    check(frame, PaperHigh.channels, false, false);
    board.nextFrame(writeBitByBit(Channels{}));
    CHECK(board.sbus.read(frame));
    check(frame, PaperHigh.channels, limit == 1, true);
    board.sbus.begin();
    board.firstFrame(writeBitByBit(Channels{}));
    CHECK(board.sbus.read(frame));
    CHECK(frame.failsafe);
  }
}

TEST_CASE("DecodeSBusNoPulses says failsafe while CH1 to CH4 of the sketch's own frame are 0: it has kept none") {
  FakeBoardOf<DecodeSBusNoPulses, sbus::Frame16NoPulses> board;
  board.sbus.begin();
  board.firstFrame(PaperHigh.bytes);
  SBusFrame kept;
  CHECK(board.sbus.read(kept));
  for (int i = 0; i < 3; i++) {
    board.nextFrame(writeBitByBit(Channels{}));
    SBusFrame fresh;
    CHECK(board.sbus.read(fresh));
    check(fresh, Channels{}, true, true);
    board.sbus.read(kept);
    check(kept, PaperHigh.channels, false, true);
  }
}

TEST_CASE("an encoder sends the frame that was read, byte for byte") {
  FakeSerial port;
  EncodeSBus encoder(port);
  encoder.begin();
  for (unsigned flags = 0; flags < 16; flags++) {
    CAPTURE(flags);
    const Frame bytes = withByte(PaperHigh.bytes, 23, flags);
    SyncedBoard board;
    SBusFrame frame;
    board.nextFrame(bytes);
    REQUIRE(board.sbus.read(frame));
    fakeMicros += 9000;
    port.written.clear();
    CHECK(encoder.write(frame));
    CHECK(port.written == bytesOf(bytes));
  }
}

TEST_CASE("a null pointer gets no channels and sends none") {
  OpenBoard board;
  uint16_t *none = nullptr;
  bool failsafe = false, lostFrame = false;
  board.firstFrame(Neutral.bytes);
  board.sbus.decodeSBusFrame(none, failsafe, lostFrame);
  CHECK(failsafe);
  CHECK(lostFrame);
  FakeBoard32 board32;
  CHECK_FALSE(board32.sbus.decodeExtraChannels(none));
  FakeSerial port;
  EncodeSBus encoder(port);
  encoder.begin();
  CHECK_FALSE(encoder.write(none, false, false));
  CHECK(port.written.empty());
}
