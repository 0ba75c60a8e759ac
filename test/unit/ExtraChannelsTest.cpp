// Futaba's extra channels: which frames with header 2F are accepted, that they cost no others, and how long
// decodeExtraChannels() returns them.
#include <doctest/doctest.h>

#include "support/Feed.h"
#include "support/FakeBoard.h"
#include "support/KnownFrames.h"
#include "support/ShowArrays.h"

namespace {

using Extra = std::array<uint16_t, 16>;

constexpr Extra Nothing = {4711};

Extra channelsOf(const Frame &frame) { return readPayload<16>(frame); }

Extra lastExtra(const ExtraFeeder &line) {
  Extra channels = Nothing;
  sbus::unpackExtra(line.finder.events().bytes(), channels.data());
  return channels;
}

// Returns what decodeExtraChannels() writes, or Nothing.
Extra extraOf(FakeBoard32 &board) {
  Extra channels = Nothing;
  const bool decoded = board.sbus.decodeExtraChannels(channels.data());
  CHECK(decoded == (channels != Nothing));
  return channels;
}

// A 2F frame, and a frame after a gap.
void receive(FakeBoard32 &board, unsigned number) {
  board.wait(6 * Ms);
  board.frame(extraFrame(number));
  board.wait(3 * Ms);
  board.frame(plainFrame(number));
}

}  // namespace

TEST_CASE(
    "a 2F frame is accepted once silence follows it, or a gap and a byte, or a header 0F or 2F, and not otherwise") {
  const struct {
    uint32_t silenceUs;  // after it; then comes another byte
    bool bySilence, byNext;
  } rows[] = {{0, false, false}, {960, false, false}, {961, false, true}, {2640, false, true}, {2641, true, true}};
  for (unsigned next = 0; next < 256; next++) {
    for (const auto &row : rows) {
      INFO("next ", next, ", silenceUs ", row.silenceUs);
      ExtraFeeder line;
      line.lock().feed(bytesOf(extraFrame(7)));
      CHECK(line.counted().extraFrames == 0);
      line.wait(row.silenceUs);
      CHECK(line.counted().extraFrames == row.bySilence);
      line.feed({static_cast<uint8_t>(next)});
      const bool accepted = row.byNext || next == 0x0F || next == 0x2F;
      CHECK(line.counted().extraFrames == accepted);
      if (accepted) {
        CHECK(lastExtra(line) == channelsOf(extraFrame(7)));
      }
      CHECK(line.finder.frame() != nullptr);
      CHECK(lastFrame(line.finder) == plainFrame(2));  // of lock()
    }
  }
}

TEST_CASE(
    "after an impaired 2F frame the next 2F and 0F frames come at once, and after an impaired 0F frame the next 2F "
    "frame") {
  for (const bool extraImpaired : {true, false}) {
    for (const size_t lost : {1u, 5u, 12u, 24u}) {
      INFO("extraImpaired ", extraImpaired, ", lost ", lost);
      ExtraFeeder line;
      line.lock();
      // Without a gap between: it may be too short to be seen.
      const Frame extra = withByte(neutralFrame(7), 0, 0x2F), frame = neutralFrame(8);
      const Frames found =
          line.feed(extraImpaired ? without(extra, lost) + bytesOf(frame) : bytesOf(extra) + without(frame, lost));
      CHECK(found == (extraImpaired ? Frames{frame} : Frames{}));
      CHECK(line.counted().extraFrames == !extraImpaired);
      line.wait(Feeder::GapUs);
      CHECK(line.feed(bytesOf(withByte(FailsafeFrame, 0, 0x2F)) + bytesOf(FailsafeFrame)) == Frames{FailsafeFrame});
      CHECK(line.counted().extraFrames == 1 + !extraImpaired);
    }
  }
}

TEST_CASE("a 2F frame is accepted only once the line variant is known, and never if that variant has none") {
  ExtraFeeder line;
  line.settle().feed(bytesOf(extraFrame(0)));
  CHECK(line.wait(Feeder::GapUs).feed(bytesOf(extraFrame(1)) + bytesOf(plainFrame(0))).empty());
  CHECK(line.counted().extraFrames == 0);
  CHECK(line.wait(Feeder::GapUs).waited == Frames{plainFrame(0)});
  CHECK(line.feed(bytesOf(extraFrame(2)) + bytesOf(plainFrame(1))) == Frames{plainFrame(1)});
  CHECK(line.counted().extraFrames == 1);

  ExtraFeeder tailed;  // an R7003SB
  tailed.lock(R7003End).feed(bytesOf(extraFrame(0, 0x00)));
  tailed.wait(Feeder::GapUs).feed(bytesOf(plainFrame(3, R7003End)) + tailOf(R7003End));
  CHECK(tailed.counted().extraFrames == 0);
}

TEST_CASE("a 2F frame's age counts from the last poll without its end, however long a silence or a block is") {
  constexpr uint32_t Idle = 4 * Feeder::CharacterUs;
  const Bytes extra = bytesOf(extraFrame(7));
  for (const uint32_t us : {3000u, 20000u, 10000000u}) {
    for (const bool headerNext : {false, true}) {
      INFO("us ", us, ", headerNext ", headerNext);
      ExtraFeeder line;
      line.lock().feed(extra);
      uint32_t before = line.now - Feeder::CharacterUs;
      if (headerNext) {
        line.block(us).poll({0x0F});
      } else {
        line.wait(us);
      }
      REQUIRE(line.counted().extraFrames == 1);
      CHECK(line.finder.events().time() == before - Idle);

      ExtraFeeder blocked;
      before = blocked.lock().now;
      blocked.block(us).poll(headerNext ? extra + Bytes{0x0F} : extra);
      blocked.wait(3000);
      REQUIRE(blocked.counted().extraFrames == 1);
      CHECK(blocked.finder.events().time() == before - Idle - (headerNext ? 5 * Feeder::CharacterUs : 0));
    }
  }
}

TEST_CASE(
    "after more than 50 ms of silence a 2F frame is rejected; the frame after it and the next 2F frame are accepted") {
  const struct {
    uint32_t silenceUs;
    unsigned extras;
  } rows[] = {{49999, 2}, {50000, 1}, {10000000, 1}};
  for (const auto &row : rows) {
    CAPTURE(row.silenceUs);
    ExtraFeeder line;
    line.lock();
    line.wait(row.silenceUs - Feeder::GapUs);  // lock() ends with that gap
    for (unsigned number = 1; number <= 2; number++) {
      CHECK(line.feed(bytesOf(extraFrame(number))).empty());
      CHECK(line.wait(Feeder::GapUs).feed(bytesOf(plainFrame(number))) == Frames{plainFrame(number)});
      line.wait(Feeder::GapUs);
    }
    CHECK(line.counted().extraFrames == row.extras);
    CHECK(lastExtra(line) == channelsOf(extraFrame(2)));
  }
}

TEST_CASE(
    "decodeExtraChannels writes the newest 2F frame until the timeout, and leaves the array alone before and after") {
  const struct {
    int timeoutMs;  // -1: not set, 100
    uint64_t goodMs;
  } rows[] = {{-1, 99}, {20, 19}, {65535, 65534}, {0, 3600 * 1000}};
  for (const auto &row : rows) {
    for (const uint64_t start : {5000 * Ms, MicrosWrap - 60 * Ms}) {
      INFO("timeoutMs ", row.timeoutMs, ", start ", start);
      fakeMicros = start;
      FakeBoard32 board;
      board.sbus.begin();
      if (row.timeoutMs >= 0) {
        board.sbus.setTimeout(static_cast<unsigned long>(row.timeoutMs));
      }
      CHECK(extraOf(board) == Nothing);
      receive(board, 0);  // before the variant is known
      CHECK(extraOf(board) == Nothing);
      receive(board, 1);
      CHECK(extraOf(board) == channelsOf(extraFrame(1)));
      receive(board, 2);
      const uint64_t age = FakeBoard::FrameUs + 3 * Ms;  // of the 2F frame: a gap and a frame have followed it
      CHECK(board.channels() == readBitByBit(plainFrame(2)));
      board.wait(row.goodMs * Ms - age);
      CHECK(extraOf(board) == channelsOf(extraFrame(2)));
      CHECK(extraOf(board) == channelsOf(extraFrame(2)));
      board.wait(1 * Ms);
      CHECK((extraOf(board) == Nothing) == (row.timeoutMs != 0));
      board.wait(MicrosWrap - 1 * Ms);  // the clock shows an earlier time again
      CHECK((extraOf(board) == Nothing) == (row.timeoutMs != 0));
      receive(board, 3);
      receive(board, 4);
      CHECK(extraOf(board) == channelsOf(extraFrame(4)));
      board.sbus.begin();
      CHECK(extraOf(board) == Nothing);
      CHECK(board.sbus.counters().extraFrames == 0);
    }
  }
}
