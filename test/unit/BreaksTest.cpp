// S.BUS2 lines with a 00, a break, after each frame and each slot, as a Futaba R7008SB sends them.
#include <doctest/doctest.h>

#include "sbus/FrameFinder.h"
#include "sbus2/Slots.h"
#include "support/Feed.h"
#include "support/ShowArrays.h"

namespace {

const Bytes Break = {0x00};

uint8_t endOf(unsigned number) { return static_cast<uint8_t>(number % 4 << 4 | 0x04); }

Bytes slotOf(unsigned number, unsigned slot) {
  return {sbus::slotId(static_cast<uint8_t>(number % 4 * 8 + slot)), 0xC0, static_cast<uint8_t>(number)};
}

// A line on which breaks are known: some frames have come, with a slot behind each, or none.
struct Line : Feeder {
  const bool hasSlots;
  unsigned number = 0;

  explicit Line(bool slots) : hasSlots(slots) {
    settle();
    for (; number < 6; number++) {
      send(plainFrame(number, endOf(number)));
    }
    REQUIRE(finder.counters().frames == 6);
  }

  Frames send(const Bytes &frame) {
    Frames frames = feed(frame + Break);
    wait(2000);
    frames = frames + waited;
    if (hasSlots) {
      frames = frames + feed(slotOf(number, 0) + Break);
    }
    wait(9000);
    return frames + waited;
  }
  Frames send(const Frame &frame) { return send(bytesOf(frame)); }
};

}  // namespace

TEST_CASE("a frame that lacks any one character is rejected, though the break completes it to 25; the next one comes") {
  for (size_t lost = 0; lost < 25; lost++) {
    for (unsigned groups = 0; groups < 8; groups++) {
      INFO("lost ", lost, ", groups ", groups);
      Line line(groups >= 4);
      line.number += groups;
      CHECK(line.send(without(plainFrame(line.number, endOf(line.number)), lost)).empty());
      const Frame next = plainFrame(line.number + 1, endOf(line.number + 1));
      CHECK(line.send(next) == Frames{next});
    }
  }
}

TEST_CASE("a receiver of another make that takes the line is believed with its second frame") {
  for (const uint8_t end : {uint8_t{0x00}, R7003End}) {
    CAPTURE(unsigned{end});
    Line line(true);
    for (unsigned number = 0; number < 4; number++) {
      Frames found = line.feed(bytesOf(plainFrame(number, end)) + tailOf(end));
      line.wait(6000);
      CHECK((found + line.waited).size() == (number == 0 ? 0 : 1));
    }
  }
}

TEST_CASE("a line may begin with such a frame; flags that are 04 indeed are believed with the second frame") {
  const auto send = [](Feeder &line, const Bytes &bytes) {
    const Frames frames = line.feed(bytes);
    return frames + line.wait(9000).waited;
  };
  for (size_t lost = 0; lost < 24; lost++) {
    CAPTURE(lost);
    Feeder line;
    line.settle();
    CHECK(send(line, without(plainFrame(0, endOf(0)), lost) + Break).empty());
    CHECK(send(line, bytesOf(plainFrame(1, endOf(1))) + Break) == Frames{plainFrame(1, endOf(1))});
  }
  for (unsigned flags = 0; flags < 16; flags++) {
    CAPTURE(flags);
    Feeder line;
    line.settle();
    const Frame frame = withByte(plainFrame(0), 23, flags);
    CHECK(send(line, bytesOf(frame)) == (flags == 0x04 ? Frames{} : Frames{frame}));
    CHECK(send(line, bytesOf(frame)) == Frames{frame});
  }
}
