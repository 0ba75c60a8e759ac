// The class DecodeSBus on a fake port of the board's core: which frame it gives when, and what a full buffer does.
#include <doctest/doctest.h>

#include <algorithm>
#include <iterator>
#include <new>

#include "KnownFrames.h"
#include "ShowArrays.h"

#include "FakeBoard.h"

TEST_CASE("before the first frame the channels are left alone, failsafe and lostFrame are true") {
  OpenBoard board;
  Channels before;
  before.fill(4711);
  for (const Bytes &bytes : {Bytes{}, part(PaperLow.bytes, 0, 24)}) {
    CAPTURE(bytes.size());
    board.take(bytes);
    CHECK_FALSE(board.sbus.SBusFrameOk());
    const Decoded decoded = board.decode(before);
    CHECK(decoded.channels == before);
    CHECK(decoded.failsafe);
    CHECK(decoded.lostFrame);
  }
}

TEST_CASE("byte by byte a frame is there with its 25th byte") {
  OpenBoard board;
  for (unsigned index = 0; index < 25; index++) {
    CAPTURE(index);
    CHECK_FALSE(board.sbus.SBusFrameOk());
    board.take(part(PaperLow.bytes, index, index + 1));
  }
  CHECK(board.sbus.SBusFrameOk());
  CHECK(board.channels() == PaperLow.channels);
}

TEST_CASE("in lumps of 16 bytes, the board's half ring, each frame is there as soon as its last byte is") {
  const Bytes bytes = bytesOf({PaperLow.bytes, PaperHigh.bytes, Neutral.bytes, PaperLow.bytes});
  const Channels *const expected[] = {nullptr,            &PaperLow.channels, &PaperLow.channels, &PaperHigh.channels,
                                      &Neutral.channels, &Neutral.channels,  &PaperLow.channels};
  OpenBoard board;
  for (size_t lump = 0; lump < 7; lump++) {
    CAPTURE(lump);
    const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(16 * lump);
    board.take(Bytes(begin, bytes.end() - begin > 16 ? begin + 16 : bytes.end()));
    CHECK(board.sbus.SBusFrameOk() == (expected[lump] != nullptr));
    if (expected[lump] != nullptr) {
      CHECK(board.channels() == *expected[lump]);
    }
  }
}

TEST_CASE("of two and a half frames at once the newest whole one is given, then the half is completed") {
  OpenBoard board;
  Bytes bytes = bytesOf({PaperLow.bytes, PaperHigh.bytes});
  const Bytes half = part(Neutral.bytes, 0, 12);
  bytes.insert(bytes.end(), half.begin(), half.end());
  CHECK(board.take(bytes) == 62);
  CHECK(board.channels() == PaperHigh.channels);
  board.take(part(Neutral.bytes, 12));
  CHECK(board.channels() == Neutral.channels);
}

TEST_CASE("of a full buffer the two whole frames count, and the torn third is not completed from behind the break") {
  OpenBoard board;
  Bytes bytes = bytesOf({PaperLow.bytes, PaperHigh.bytes, Neutral.bytes, PaperLow.bytes});
  CHECK(board.take(bytes) == 64);
  CHECK(board.channels() == PaperHigh.channels);
  // Behind the break the line goes on with the 11 bytes that the torn frame is short of, but of another frame.
  board.take(part(PaperLow.bytes, 14));
  CHECK(board.channels() == PaperHigh.channels);
  board.take(bytesOf({Neutral.bytes}) + Bytes{0x0F});  // behind a break a frame may wait for the next header
  CHECK(board.channels() == Neutral.channels);
}

TEST_CASE("the break of a full buffer lies behind it: a frame begun before is completed with its first bytes") {
  OpenBoard board;
  board.take(part(PaperLow.bytes, 0, 12));
  Bytes bytes = part(PaperLow.bytes, 12);
  bytes.resize(64, 0xA5);
  CHECK(board.take(bytes) == 64);
  CHECK(board.sbus.SBusFrameOk());
  CHECK(board.channels() == PaperLow.channels);
}

TEST_CASE("what comes in while a full buffer is read out stands behind the break, and completes nothing from before it") {
  for (const bool atOnce : {false, true}) {
    CAPTURE(atOnce);
    OpenBoard board;
    unsigned reads = 0;
    bool come = false;
    // Behind the 14 bytes of the torn frame the 11 that it is short of, but of another frame.
    const auto comeIn = [&] {
      if (reads == 1 && !come) {
        come = true;
        board.port.arrive(part(PaperLow.bytes, 14));
      }
    };
    board.port.beforeAvailable = [&] {
      if (atOnce) {
        comeIn();
      }
    };
    board.port.beforeRead = [&] {
      comeIn();
      reads++;
    };
    CHECK(board.take(bytesOf({PaperLow.bytes, PaperHigh.bytes, Neutral.bytes})) == 64);
    CHECK(come);
    CHECK(board.sbus.counters().frames == 2);
    board.sbus.parseSBusFrame();
    CHECK(board.port.available() == 0);
    CHECK(board.sbus.counters().frames == 2);
    CHECK(board.channels() == PaperHigh.channels);
    CHECK(board.sbus.counters().overflows == 1);
  }
}

TEST_CASE("a port that fails to read what it says it has ends the look") {
  OpenBoard board;
  board.port.beforeAvailable = [&] { board.port.readFails = true; };
  board.take(Bytes(40, 0xA5));
  CHECK(board.sbus.counters().frames == 0);
}

TEST_CASE("with timeout 0, as in the paper, the last frame stays, however long nothing comes") {
  OpenBoard board;
  board.sbus.setTimeout(0);
  board.take(bytesOf({PaperHigh.bytes}));
  for (unsigned look = 0; look < 1000; look++) {
    board.wait(1000000);
    board.take({});
  }
  CHECK(board.sbus.SBusFrameOk());
  CHECK(board.channels() == PaperHigh.channels);
}

TEST_CASE("decoding the same frame twice gives the same twice") {
  OpenBoard board;
  board.take(bytesOf({Neutral.bytes}));
  CHECK(board.channels() == Neutral.channels);
  CHECK(board.channels() == Neutral.channels);
}

TEST_CASE("CH17, CH18, lostFrame and failsafe are flags bits 0..3") {
  for (unsigned flags = 0; flags < 16; flags++) {
    CAPTURE(flags);
    OpenBoard board;
    Frame frame = PaperLow.bytes;
    frame[23] = static_cast<uint8_t>(flags);
    board.take(bytesOf({frame}));
    const Decoded decoded = board.decode();
    CHECK(decoded.channels[16] == ((flags & 1) != 0 ? 1 : 0));
    CHECK(decoded.channels[17] == ((flags & 2) != 0 ? 1 : 0));
    CHECK(decoded.lostFrame == ((flags & 4) != 0));
    CHECK(decoded.failsafe == ((flags & 8) != 0));
  }
}

TEST_CASE("two objects side by side do not disturb each other") {
  OpenBoard left;
  OpenBoard right;
  for (unsigned index = 0; index < 25; index++) {
    left.take(part(PaperLow.bytes, index, index + 1));
    if (index < 24) {
      right.take(part(PaperHigh.bytes, index, index + 1));
    }
  }
  CHECK(left.channels() == PaperLow.channels);
  CHECK_FALSE(right.sbus.SBusFrameOk());
  right.take(part(PaperHigh.bytes, 24));
  CHECK(right.channels() == PaperHigh.channels);
  CHECK(left.channels() == PaperLow.channels);
}

TEST_CASE("before begin, wherever the object stands, there is no frame, none is new, and a look finds nothing") {
  alignas(FakeBoard) unsigned char memory[sizeof(FakeBoard)];
  for (const int garbage : {0x00, 0x0F, 0xFF}) {
    CAPTURE(garbage);
    std::fill(std::begin(memory), std::end(memory), static_cast<unsigned char>(garbage));
    FakeBoard *const board = new (memory) FakeBoard;
    CHECK_FALSE(board->sbus.newFrame());
    CHECK_FALSE(board->sbus.SBusFrameOk());
    CHECK(board->sbus.linkState() == sbus::LinkState::NeverSeen);
    CHECK(board->sbus.counters().frames == 0);
    board->sbus.parseSBusFrame();
    CHECK(board->decode().failsafe);
    board->~FakeBoard();
  }
}
