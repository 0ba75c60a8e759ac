// DecodeSBusCallback: which frames it hands to the sketch's function, when, and what the function can read meanwhile.
#include <doctest/doctest.h>

#include <vector>

#include "support/FakeBoard.h"
#include "support/KnownFrames.h"
#include "support/ShowArrays.h"

// After Arduino.h.
#include <DecodeSBus2.h>

namespace {

struct Call {
  Channels channels;
  bool failsafe, lostFrame;

  bool operator==(const Call &other) const {
    return channels == other.channels && failsafe == other.failsafe && lostFrame == other.lostFrame;
  }
};

std::vector<Call> calls;
DecodeSBusCallback *asked = nullptr;  // within the function

void received(const uint16_t channels[], bool failsafe, bool lostFrame) {
  Call call = {{}, failsafe, lostFrame};
  for (size_t i = 0; i < call.channels.size(); i++) {
    call.channels[i] = channels[i];
  }
  calls.push_back(call);
  if (asked != nullptr) {
    CHECK(asked->linkState() == (failsafe    ? sbus::LinkState::Failsafe
                                 : lostFrame ? sbus::LinkState::Lossy
                                             : sbus::LinkState::Ok));
    CHECK(asked->frameAge() < 5);
    CHECK_FALSE(asked->newFrame());
    Call again = {{}, !failsafe, !lostFrame};
    asked->decodeSBusFrame(again.channels.data(), again.failsafe, again.lostFrame);
    CHECK(again == call);
  }
}

template <typename Decoder, typename Format = sbus::Frame16>
struct CallingOf : FakeBoardOf<DecodeSBusCallbackOf<Decoder>, Format> {
  CallingOf() {
    calls.clear();
    this->sbus.onFrame(received);
    this->sbus.begin();
  }
};

using Calling = CallingOf<DecodeSBus>;

}  // namespace

TEST_CASE(
    "each frame is handed over once, at the poll that completes it, with its flags, also lost and failsafe frames") {
  Calling board;
  asked = &board.sbus;
  board.firstFrame(Neutral.bytes);
  REQUIRE(calls.size() == 1);
  CHECK(calls[0].channels == Neutral.channels);
  for (unsigned flags = 0; flags < 16; flags++) {
    CAPTURE(flags);
    const Frame frame = withByte(PaperHigh.bytes, 23, flags);
    board.nextFrame(frame);
    REQUIRE(calls.size() == 2 + flags);
    CHECK(calls.back() == Call{readBitByBit(frame), (flags & 8) != 0, (flags & 4) != 0});
    board.wait(1 * Ms);
    board.wait(1 * Ms);
    CHECK(calls.size() == 2 + flags);
  }
  asked = nullptr;
}

TEST_CASE(
    "the function is not called before a frame, for half a frame, when frames stop, or after it is removed; begin() "
    "keeps it") {
  Calling board;
  board.wait(20 * Ms);
  board.take(part(Neutral.bytes, 0, 24));
  CHECK(calls.empty());
  board.wait(20 * Ms);
  board.sbus.begin();
  board.firstFrame(Neutral.bytes);
  CHECK(calls.size() == 1);
  for (unsigned i = 0; i < 200; i++) {
    board.wait(1 * Ms);
  }
  CHECK(calls.size() == 1);
  CHECK(board.sbus.linkState() == sbus::LinkState::Stale);
  board.sbus.onFrame(nullptr);
  board.nextFrame(PaperLow.bytes);
  CHECK(calls.size() == 1);
  CHECK(board.channels() == PaperLow.channels);
}

TEST_CASE(
    "of two frames in one poll it gets the newer one; it never gets a frame that is as old as the timeout when it is "
    "read") {
  Calling board;
  board.firstFrame(Neutral.bytes);
  board.block(9 * Ms);
  board.poll(join({PaperLow.bytes, PaperHigh.bytes}));
  REQUIRE(calls.size() == 2);
  CHECK(calls[1].channels == PaperHigh.channels);
  board.block(150 * Ms);  // loop() was busy: when the frame came is not known
  board.poll(bytesOf(PaperLow.bytes));
  board.wait(FakeBoard::SilenceUs);
  CHECK(board.sbus.counters().frames == 4);
  CHECK(calls.size() == 2);
}

TEST_CASE("a run of lost frames as long as the loss limit is handed over as failsafe") {
  Calling board;
  board.sbus.setLossLimit(3);
  board.firstFrame(Neutral.bytes);
  for (unsigned i = 1; i <= 4; i++) {
    board.nextFrame(withByte(Neutral.bytes, 23, 4));
    REQUIRE(calls.size() == 1 + i);
    CHECK(calls.back() == Call{Neutral.channels, i >= 3, true});
  }
}

TEST_CASE(
    "the other decoders call it as well: 24 channels, telemetry; DecodeSBusNoPulses repeats the channels before") {
  CallingOf<DecodeSBus2> telemetry;
  telemetry.firstFrame(Neutral.bytes);
  CHECK(calls.size() == 1);

  CallingOf<DecodeSBusNoPulses, sbus::Frame16NoPulses> noPulses;
  const Frame none = writeBitByBit(Channels{});
  noPulses.firstFrame(none);
  noPulses.nextFrame(PaperHigh.bytes);
  noPulses.nextFrame(none);
  CHECK(calls == std::vector<Call>{
                     {Channels{}, false, true}, {PaperHigh.channels, false, false}, {PaperHigh.channels, false, true}});

  static uint16_t last = 0;
  LongChannels channels = {};
  channels[23] = 1234;
  LongFrame frame;
  sbus::pack24(frame.data(), channels.data(), false, false);
  FakeBoardOf<DecodeSBusCallbackOf<DecodeSBus24>, sbus::Frame24> long24;
  long24.sbus.onFrame([](const uint16_t values[], bool, bool) { last = values[23]; });
  long24.sbus.begin();
  long24.firstFrame(frame);
  CHECK(last == 1234);
}
