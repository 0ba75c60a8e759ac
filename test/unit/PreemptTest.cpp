// parseSBusFrame() at PendSV level while loop() reads: every reader, interrupted after each of its instructions
// (support/SingleStep.h). The interrupt takes in whole frames, as Serial1.onReceive() would. The library is compiled
// here as for the board: -Os, no sanitizers.
#include <doctest/doctest.h>

#include <array>
#include <vector>

#include "support/Feed.h"
#include "support/ShowArrays.h"
#include "support/SingleStep.h"

#include "support/FakeBoard.h"

#include "../../examples/PpmOut/Ppm.h"

#if defined(SINGLE_STEP)

namespace {

// Returns frame `number`: every channel and every flag says which frame it is from.
constexpr unsigned FrameKinds = 16;
Channels channelsOf(unsigned number) {
  Channels channels{};
  for (unsigned channel = 0; channel < 16; channel++) {
    channels[channel] = static_cast<uint16_t>(1024 + 16 * channel + number % FrameKinds);
  }
  channels[16] = number & 1;
  return channels;
}
bool lostOf(unsigned number) { return (number & 1) != 0; }
bool failsafeOf(unsigned number) { return (number & 2) != 0; }
Frame frameOf(unsigned number) {
  Frame frame = writeBitByBit(channelsOf(number));
  frame[23] = static_cast<uint8_t>(frame[23] | (lostOf(number) ? 4 : 0) | (failsafeOf(number) ? 8 : 0));
  return frame;
}

struct Situation {
  doctest::String what;
  unsigned framesBefore;  // have come when the reader begins
  uint32_t ageMs;         // of the newest of them
  unsigned framesDuring;  // come in during the interrupt
  uint32_t interruptMs;   // how long the interrupt lasts after these frames
  bool stale;             // the link would be, without the interrupt
};

using Situations = std::vector<Situation>;

const Situations All = {
    {"one frame comes", 3, 9, 1, 0, false},
    {"two frames come", 3, 9, 2, 0, false},
    {"three frames come", 3, 9, 3, 0, false},
    {"two frames come, and the clock goes on by 20 ms", 3, 9, 2, 20, false},
    {"the link is stale, one frame comes", 3, 150, 1, 0, true},
    {"the link is stale, three frames come", 3, 150, 3, 1, true},
    {"the link is about to become stale, two frames come", 3, 99, 2, 5, false},
    {"the very first frame comes", 0, 150, 1, 0, true},
    {"the first three frames come", 0, 150, 3, 7, true},
};

// After these interrupts all frames are stale.
const Situations Long = {{"two frames come, then 200 ms", 3, 9, 2, 200, false},
                         {"one frame comes, then 200 ms", 3, 9, 1, 200, false}};

// The board that a reader reads, a new one for each instruction.
struct Scene {
  OpenBoard board;
  unsigned next = 0;  // frame

  explicit Scene(const Situation &situation) {
    for (unsigned i = 0; i < situation.framesBefore; i++) {
      board.wait(6 * Ms);
      receive();
    }
    board.wait(situation.ageMs * Ms);
  }
  void receive() {
    next == 0 ? board.firstFrame(frameOf(0)) : board.frame(frameOf(next));
    REQUIRE(board.sbus.counters().frames == ++next);
  }
};

Scene *scene;
const Situation *situation;

void framesComeIn() {
  for (unsigned i = 0; i < situation->framesDuring; i++) {
    scene->receive();
  }
  fakeMicros += situation->interruptMs * Ms;
}

// Interrupts `reader(board)` after each of its instructions, in each situation; then calls `check(scene, happened)`.
template <typename Reader, typename Check>
void everyInstruction(const Reader &reader, const Check &check, const Situations &situations = All) {
  interrupt = framesComeIn;
  for (const Situation &row : situations) {
    CAPTURE(row.what);
    situation = &row;
    forEveryInstruction([&](unsigned long instruction) {
      fakeMicros = 1000000 + instruction * 131;  // at any time within a millisecond
      Scene now(row);
      scene = &now;
      const bool happened = interrupted(instruction, [&] { reader(now.board); });
      if (!happened) {
        CHECK(instruction > 3);  // otherwise nothing was proved
        framesComeIn();
      }
      check(now, happened);
      return happened;
    });
  }
}

}  // namespace

TEST_CASE(
    "decodeSBusFrame() gives one frame with its own flags, or none if it is stale; newFrame() says if it was the "
    "newest") {
  Decoded decoded;
  everyInstruction([&](FakeBoard &board) { decoded = board.decode(); },
                   [&](Scene &now, bool) {
                     const bool young = situation->interruptMs < 100;  // after the interrupt
                     unsigned given = UINT32_MAX;                      // the number of the frame
                     for (unsigned number = 0; number < now.next; number++) {
                       if (decoded.channels == channelsOf(number)) {
                         given = number;
                       }
                     }
                     if (given == UINT32_MAX) {
                       REQUIRE(decoded.channels == Untouched);
                       REQUIRE((situation->stale || !young));  // when the reader began, or after the interrupt
                       REQUIRE(decoded.failsafe);
                       REQUIRE(decoded.lostFrame);
                     } else {
                       REQUIRE(given + 1 >= situation->framesBefore);
                       REQUIRE(decoded.failsafe == failsafeOf(given));
                       REQUIRE(decoded.lostFrame == lostOf(given));
                     }
                     REQUIRE(now.board.sbus.newFrame() == (young && given + 1 != now.next));
                     // The next call is undisturbed, and gives the newest.
                     REQUIRE(now.board.channels() == (young ? channelsOf(now.next - 1) : Untouched));
                     REQUIRE_FALSE(now.board.sbus.newFrame());
                     REQUIRE(now.board.sbus.counters().frames == now.next);
                   },
                   All + Long);
}

TEST_CASE(
    "SBusFrameOk(), linkState(), frameAge(), newFrame() and counters() are those before the interrupt, or of one of "
    "the "
    "frames that came") {
  bool ok = false, fresh = false;
  sbus::LinkState state{};
  unsigned long age = 0;
  uint32_t frames = 0;
  everyInstruction(
      [&](FakeBoard &board) {
        ok = board.sbus.SBusFrameOk();
        state = board.sbus.linkState();
        age = board.sbus.frameAge();
        fresh = board.sbus.newFrame();
        frames = board.sbus.counters().frames;
      },
      [&](Scene &now, bool happened) {
        const auto expected = [](unsigned number) {
          return failsafeOf(number) ? sbus::LinkState::Failsafe
                 : lostOf(number)   ? sbus::LinkState::Lossy
                                    : sbus::LinkState::Ok;
        };
        const unsigned before = situation->framesBefore;
        bool right = situation->stale && state == (before == 0 ? sbus::LinkState::NeverSeen : sbus::LinkState::Stale);
        for (unsigned number = before == 0 ? 0 : before - 1; number < now.next; number++) {
          right = right || state == expected(number);
        }
        REQUIRE(right);
        REQUIRE((ok || situation->stale));
        REQUIRE((happened || ok == !situation->stale));
        REQUIRE((fresh || situation->stale));
        REQUIRE(frames >= before);
        REQUIRE(frames <= now.next);
        const bool never = before == 0 && age == ULONG_MAX;
        REQUIRE((never || age <= situation->ageMs + 4 * situation->framesDuring + situation->interruptMs + 1));
        REQUIRE(now.board.sbus.linkState() == expected(now.next - 1));
        REQUIRE(now.board.sbus.newFrame());
      });
}

TEST_CASE("decodeExtraChannels() writes one 2F frame, or leaves the array alone if the newest is stale") {
  using Extra = std::array<uint16_t, 16>;
  const Extra nothing = {4711};
  static FakeBoard32 *board;
  static unsigned next, during;  // 2F frames: the number of the next, and how many come in during the interrupt
  static uint64_t interruptMs;
  static const auto receive = [] {
    board->wait(4 * Ms);
    board->frame(withByte(frameOf(next++), 0, 0x2F));
    board->wait(1 * Ms);
    board->frame(frameOf(0));
  };
  const auto extra = [](unsigned number) { return readPayload<16>(frameOf(number)); };
  interrupt = [] {
    for (unsigned i = 0; i < during; i++) {
      receive();
    }
    fakeMicros += interruptMs * Ms;
  };
  const struct {
    doctest::String what;
    uint64_t ageMs;
    unsigned during;
    uint64_t interruptMs;
    bool stale;  // they would be, without the interrupt
  } rows[] = {{"one comes", 9, 1, 0, false},
              {"two come", 9, 2, 0, false},
              {"one comes, then 200 ms", 9, 1, 200, false},
              {"two come, then 200 ms", 9, 2, 200, false},
              {"the channels are about to become stale, one comes", 95, 1, 0, false},
              {"they are stale, one comes", 150, 1, 0, true},
              {"they are stale, two come, then 200 ms", 150, 2, 200, true}};
  for (const auto &row : rows) {
    CAPTURE(row.what);
    during = row.during;
    interruptMs = row.interruptMs;
    forEveryInstruction([&](unsigned long instruction) {
      fakeMicros = 1000000 + instruction * 131;
      FakeBoard32 now;
      now.sbus.begin();
      board = &now;
      for (next = 0; next < 3;) {
        receive();
      }
      uint64_t us = row.ageMs * Ms - 1 * Ms - FakeBoard32::FrameUs;
      for (; us >= 9 * Ms; us -= 9 * Ms) {  // after more than 50 ms of silence a 2F frame is not aligned
        now.nextFrame(frameOf(0));
      }
      now.wait(us);
      Extra channels = nothing;
      bool decoded = false;
      const bool happened = interrupted(instruction, [&] { decoded = now.sbus.decodeExtraChannels(channels.data()); });
      if (!happened) {
        CHECK(instruction > 3);
        CHECK(decoded == !row.stale);
        interrupt();
      }
      bool right = !decoded && channels == nothing && (row.stale || row.interruptMs != 0);
      for (unsigned number = row.stale ? 3 : 2; number < next; number++) {
        right = right || (decoded && channels == extra(number));
      }
      REQUIRE(right);
      channels = nothing;
      REQUIRE(now.sbus.decodeExtraChannels(channels.data()) == (row.interruptMs == 0));
      REQUIRE(channels == (row.interruptMs == 0 ? extra(next - 1) : nothing));
      return happened;
    });
  }
}

TEST_CASE("this proof finds the fault of a reader that does not repeat its read") {
  static Feeder *line;
  interrupt = [] {
    line->feed(bytesOf(frameOf(1)), 25);
    line->feed(bytesOf(frameOf(2)), 25);
  };
  unsigned mixtures = 0;
  forEveryInstruction([&](unsigned long instruction) {
    Feeder now;
    line = &now.lock();
    REQUIRE(now.feed(bytesOf(frameOf(0)), 25).size() == 1);
    Channels channels;
    const bool happened = interrupted(instruction, [&] { sbus::unpack(now.finder.frame(), channels.data()); });
    mixtures += channels != channelsOf(0) && channels != channelsOf(1) && channels != channelsOf(2);
    return happened;
  });
  CHECK(mixtures > 20);
}

// On an ESP32 next() runs in a task on another core, which Wi-Fi may stop while loop() goes round.
TEST_CASE(
    "PpmOut: a frame has the channels of one write(), though two more writes come after any instruction of next()") {
  static Ppm *ppm;
  static int16_t us;
  const auto write = [] {
    int16_t channels[Ppm::Channels];
    us++;
    for (int16_t &channel : channels) {
      channel = us;
    }
    ppm->write(channels);
  };
  static const auto writeAgain = write;
  interrupt = [] {
    writeAgain();
    writeAgain();
  };
  forEveryInstruction([&](unsigned long instruction) {
    Ppm now;
    ppm = &now;
    us = 1500;
    write();
    const bool happened = interrupted(instruction, [] { ppm->next(); });
    const int first = 300 + now.next().us;
    REQUIRE(first > 1500);
    for (unsigned channel = 1; channel < Ppm::Channels; channel++) {
      REQUIRE(now.next().us == 300);
      REQUIRE(300 + now.next().us == first);
    }
    return happened;
  });
}

#else

TEST_CASE("skipped: the proof needs an x86-64 under Linux for its single steps") {
  MESSAGE("the readers were not interrupted after each instruction");
}

#endif
