// The Grasshopper's port tells when its line was idle, except where its bytes end on a half of its ring. For each place
// of that ring where a line may begin: what this finds, that no frame is made of two, and what it costs.
#include <doctest/doctest.h>

#include <algorithm>
#include <functional>
#include <vector>

#include "line/simulation/Random.h"
#include "support/Bytes.h"
#include "support/KnownFrames.h"
#include "support/ShowArrays.h"

#include "support/ListeningBoard.h"

namespace {

constexpr uint64_t Ms = 1000;  // us
constexpr size_t HalfRing = 16;

// Frames whose parts may look like a frame in many ways.
enum class Payload { Zero, ZeroAtFirst, Neutral, SecondReading };
constexpr Payload Payloads[] = {Payload::Zero, Payload::ZeroAtFirst, Payload::Neutral, Payload::SecondReading};

Frame frameOf(Payload payload, unsigned number) {
  Channels channels{};
  switch (payload) {
    case Payload::Zero:
      return countingFrame(0, 1, number, 0x00);
    case Payload::ZeroAtFirst:
      channels[8] = static_cast<uint16_t>(1 + number);
      return writeBitByBit(channels);
    case Payload::Neutral:
      return neutralFrame(number);
    case Payload::SecondReading:
      break;
  }
  Frame frame = SecondReading;
  frame[5] = static_cast<uint8_t>(number);
  return frame;
}

// A board that listens, and checks each frame that it hands over: it was sent whole, after the one before it, and is no
// younger than it is.
template <typename Port = CallingPort>
struct Watching : ListeningBoardOf<DecodeSBus, Port> {
  using Board = ListeningBoardOf<DecodeSBus, Port>;
  struct Sent {
    Channels channels;
    uint64_t endUs;
  };

  Payload payload;
  unsigned number = 0;  // of the next frame
  std::vector<Sent> sent;
  size_t next = 0;  // of those sent, that may be handed over next
  unsigned frames = 0, wrong = 0, young = 0;

  // `ringAt`: where the first frame begins in the port's ring.
  explicit Watching(Payload which = Payload::Neutral, size_t ringAt = 0) : payload(which) {
    Board::sbus.setTimeout(0);
    Board::sbus.begin();
    Board::called = [this] { take(); };
    Board::send(Bytes(ringAt, 0x55));
    Board::pass(60 * Ms);
  }

  void take() {
    if (!Board::sbus.newFrame()) {
      return;
    }
    Channels channels{};
    bool failsafe, lostFrame;
    Board::sbus.decodeSBusFrame(channels.data(), failsafe, lostFrame);
    const uint64_t ageUs = (Board::sbus.frameAge() + 1) * Ms;
    const auto found = std::find_if(sent.begin() + static_cast<std::ptrdiff_t>(next), sent.end(),
                                    [&](const Sent &each) { return each.channels == channels; });
    frames++;
    if (found == sent.end()) {
      wrong++;
      return;
    }
    next = static_cast<size_t>(found - sent.begin()) + 1;
    young += fakeMicros - found->endUs >= ageUs;
  }

  Frame frame() const { return frameOf(payload, number); }
  // Sends the next frame, and the silence until another begins.
  void whole(uint64_t periodUs = 9 * Ms) {
    const Frame bytes = frame();
    number++;
    sent.push_back({readBitByBit(bytes), fakeMicros + 25 * Board::CharacterUs});
    Board::send(bytesOf(bytes));
    Board::pass(periodUs - 25 * Board::CharacterUs);
  }
  void wholes(unsigned count, uint64_t periodUs = 9 * Ms) {
    for (unsigned i = 0; i < count; i++) {
      whole(periodUs);
    }
  }
  // Sends some characters of the next frame, which do not make a whole one.
  void some(const Bytes &bytes, uint64_t periodUs = 9 * Ms) {
    number++;
    Board::send(bytes);
    Board::pass(periodUs - bytes.size() * Board::CharacterUs);
  }
  void check() const {
    CHECK(wrong == 0);
    CHECK(young == 0);
  }
};

}  // namespace

TEST_CASE("noise, a silence of one character or more, and a frame: the frame comes, and none is wrong") {
  const Bytes noises[] = {{0x0F, 0x91}, {0x0F}, {0x0F, 0x00}, {0x0F, 0x0F, 0x00}, {0x0F, 0x55, 0x00, 0x0F},
                          {0x2F, 0x91}};
  for (const Payload payload : Payloads) {
    for (size_t ringAt = 0; ringAt < HalfRing; ringAt++) {
      for (const Bytes &noise : noises) {
        for (const uint64_t silenceUs : {120u, 180u, 240u, 480u, 600u, 900u, 1500u, 3000u}) {
          INFO("payload ", static_cast<int>(payload), ", ringAt ", ringAt, ", noise ", noise, ", silenceUs ",
               silenceUs);
          Watching<> board(payload, ringAt);
          board.wholes(4);
          board.send(noise);
          board.pass(silenceUs);
          board.wholes(3);
          if ((ringAt + 4 * 25 + noise.size()) % HalfRing == 0) {
            continue;  // the silence looks like a late call
          }
          board.check();
          CHECK(board.frames == board.sent.size());
        }
      }
    }
  }
}

TEST_CASE("calls that come late by up to 2 ms, as behind other work at their level, cost no frame of a line in sync") {
  for (const uint32_t latestUs : {300u, 500u, 1000u, 1500u, 2000u}) {
    for (const uint64_t periodUs : {7 * Ms, 9 * Ms, 14 * Ms, 15 * Ms}) {
      for (const Payload payload : Payloads) {
        INFO("latestUs ", latestUs, ", periodUs ", periodUs, ", payload ", static_cast<int>(payload));
        line::Random random(latestUs);
        Watching<> board(payload);
        board.wholes(3, periodUs);
        for (unsigned i = 0; i < 100; i++) {
          board.heldUpUs = random.below(latestUs + 1);
          board.whole(periodUs);
        }
        board.pass(20 * Ms);
        board.check();
        CHECK(board.frames == board.sent.size());
        CHECK(board.sbus.counters().discardedBytes == 0);
      }
    }
  }
}

TEST_CASE("a frame that lost characters does not join the next one, wherever it ends in the port's ring") {
  for (const Payload payload : Payloads) {
    for (const uint64_t periodUs : {4 * Ms, uint64_t{6300}, 7 * Ms, 9 * Ms, 14 * Ms}) {
      for (size_t ringAt = 0; ringAt < HalfRing; ringAt++) {
        for (const size_t lost : {1u, 2u, 3u, 7u, 12u, 20u}) {
          INFO("payload ", static_cast<int>(payload), ", periodUs ", periodUs, ", ringAt ", ringAt, ", lost ", lost);
          Watching<> board(payload, ringAt);
          board.wholes(6, periodUs);
          const size_t missed = board.sent.size() - board.frames;
          CHECK(missed <= (periodUs == 4 * Ms ? 4 : 1));  // its silences are too short for the clock to prove one
          for (size_t place = 0; place + lost <= 25; place++) {
            board.some(part(board.frame(), 0, place) + part(board.frame(), place + lost), periodUs);
            board.wholes(2, periodUs);
          }
          board.check();
          CHECK(board.frames + missed == board.sent.size());
        }
      }
    }
  }
}

TEST_CASE("... nor if the sender is silent within each frame") {
  for (const Payload payload : Payloads) {
    for (const uint64_t periodUs : {9 * Ms, 14 * Ms}) {
      for (size_t ringAt = 0; ringAt < HalfRing; ringAt++) {
        for (const size_t silentAfter : {1u, 2u, 3u, 7u, 20u}) {
          INFO("payload ", static_cast<int>(payload), ", periodUs ", periodUs, ", ringAt ", ringAt, ", silentAfter ",
               silentAfter);
          constexpr uint64_t SilentUs = 420;
          Watching<> board(payload, ringAt);
          const auto send = [&](const Bytes &bytes) {
            board.send(part(bytes, 0, silentAfter));
            board.pass(SilentUs);
            board.some(part(bytes, silentAfter), periodUs - silentAfter * board.CharacterUs - SilentUs);
          };
          for (unsigned i = 0; i < 40; i++) {
            board.sent.push_back({readBitByBit(board.frame()), fakeMicros + 25 * board.CharacterUs + SilentUs});
            send(bytesOf(board.frame()));
            if (i % 4 == 3) {  // together with the beginning of the next one it has 25 characters
              send(part(board.frame(), 0, 10) + part(board.frame(), 10 + silentAfter));
            }
          }
          board.check();
          CHECK(board.frames >= 30);
        }
      }
    }
  }
}

TEST_CASE("one read takes a whole frame, wherever it lies in the ring") {
  for (size_t ringAt = 0; ringAt < HalfRing; ringAt++) {
    CAPTURE(ringAt);
    Watching<> board(Payload::Neutral, ringAt);
    board.wholes(16);
    REQUIRE(board.frames == 16);
    for (unsigned number = 0; number < 16; number++) {
      CAPTURE(number);
      const unsigned reads = board.port.reads(), asked = board.port.asked();
      board.whole();
      CHECK(board.port.reads() - reads == 1);
      CHECK(board.port.asked() - asked == 1);
    }
    CHECK(board.port.bytesRead() == ringAt + 32 * 25);
  }
}

TEST_CASE("a port that calls back, and does not tell when its line was idle, works as one that is polled") {
  for (const uint64_t periodUs : {6 * Ms, 7 * Ms, 9 * Ms, 15 * Ms}) {
    for (const Payload payload : Payloads) {
      INFO("periodUs ", periodUs, ", payload ", static_cast<int>(payload));
      Watching<UnknownCallingPort> board(payload);
      for (unsigned i = 0; i < 100; i++) {
        const unsigned reads = board.port.reads();
        board.whole(periodUs - Ms);
        CHECK(board.port.reads() - reads >= 2);  // no part of a frame is left unread
        board.sbus.parseSBusFrame();             // finds nothing, which shows the gap
        board.take();
        board.pass(Ms);
      }
      board.check();
      CHECK(board.frames == board.sent.size());
      CHECK(board.sbus.counters().discardedBytes == 0);
    }
  }
}

TEST_CASE(
    "begin() within a frame restarts the port's ring: the rest of that frame is rejected, and the next frames come") {
  for (const Payload payload : Payloads) {
    for (size_t ringAt = 0; ringAt < HalfRing; ringAt++) {
      for (size_t place = 1; place < 25; place++) {
        INFO("payload ", static_cast<int>(payload), ", ringAt ", ringAt, ", place ", place);
        Watching<> board(payload, ringAt);
        board.wholes(4);
        board.check();
        board.send(part(board.frame(), 0, place));
        board.sbus.begin();
        board.some(part(board.frame(), place));
        CHECK(board.sbus.counters().frames == 0);
        board.wholes(4);
        board.check();
        CHECK(board.sbus.counters().frames >= 3);
        CHECK(board.next == board.sent.size());
      }
    }
  }
}

namespace {

// Frames whose calls are held up, from each third place of a frame on, until `lost` others have come. Returns how often
// the port's buffer was full.
unsigned holdUp(Watching<> &board, unsigned lost) {
  unsigned full = 0;
  for (size_t place = 0; place < 25; place += 3) {
    const Frame frame = board.frame();
    board.send(part(frame, 0, place));
    board.isHeld = true;
    board.some(part(frame, place));
    board.wholes(lost);
    full += 25 - place % HalfRing + 25 * lost > 64;
    board.isHeld = false;
    board.wholes(3);
  }
  return full;
}

}  // namespace

TEST_CASE("calls that come so late that the port's 64 bytes overflow: no frame is wrong, and all goes on") {
  for (const Payload payload : Payloads) {
    for (size_t ringAt = 0; ringAt < HalfRing; ringAt++) {
      for (const unsigned lost : {1u, 2u, 3u, 9u}) {
        INFO("payload ", static_cast<int>(payload), ", ringAt ", ringAt, ", lost ", lost);
        Watching<> board(payload, ringAt);
        board.wholes(4);
        holdUp(board, lost);
        board.check();
        const size_t frames = board.sbus.counters().frames;
        board.wholes(5);
        board.check();
        CHECK(board.sbus.counters().frames == frames + 5);
      }
    }
  }
}
