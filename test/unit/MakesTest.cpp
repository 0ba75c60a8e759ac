// What receivers of other makes send: S.BUS2 with telemetry, R7003SB, further frames in between, another receiver later.
#include "sbus/Receiver.h"

#include <doctest/doctest.h>

#include "Feed.h"
#include "KnownFrames.h"
#include "ShowArrays.h"

namespace {

const Bytes R7003Tail = {0x00, 0x03, 0xC0, 0x33, 0x00};
const Bytes Telemetry = {0x03, 0xC0, 0x2E};

constexpr uint32_t Loops[] = {50, 500, 1000, 3000};  // us

// Lines of both centres: without and with 0F in the payload.
Frame frameOf(bool neutral, unsigned number, uint8_t end) {
  return neutral ? neutralFrame(number, end) : plainFrame(number, end);
}

// True if `found` is `sent` with some frames left out.
bool isPartOf(const Frames &found, const Frames &sent) {
  auto at = sent.begin();
  for (const Frame &frame : found) {
    at = std::find(at, sent.end(), frame);
    if (at == sent.end()) {
      return false;
    }
    ++at;
  }
  return true;
}

}  // namespace

TEST_CASE("of an R7003SB, five bytes behind each end byte 08, every frame is delivered") {
  for (const bool neutral : {false, true}) {
    for (const uint64_t pauseUs : {1000u, 4000u, 11000u}) {
      Wire wire;
      Frames sent;
      for (unsigned number = 0; number < 40; number++) {
        sent.push_back(frameOf(neutral, number, 0x08));
        wire.send(sent.back()).send(R7003Tail).pause(pauseUs);
      }
      for (const uint32_t loopUs : Loops) {
        CAPTURE(neutral);
        CAPTURE(pauseUs);
        CAPTURE(loopUs);
        CHECK(wire.frames(loopUs) == sent);
      }
    }
  }
}

TEST_CASE("of an R7003SB every frame is delivered in lumps of any size, without any pause") {
  for (size_t lump = 1; lump <= 64; lump++) {
    CAPTURE(lump);
    Bytes line;
    Frames sent;
    for (unsigned number = 0; number < 10; number++) {
      sent.push_back(neutralFrame(number, 0x08));
      line = line + bytesOf(sent.back()) + R7003Tail;
    }
    CHECK(feedNew(line, lump) == sent);
  }
}

TEST_CASE("an R7003SB is found again behind a break, even without any pause") {
  for (const bool neutral : {false, true}) {
    CAPTURE(neutral);
    Feeder line;
    line.receiver.broken();
    Frames found;
    for (unsigned number = 0; number < 20; number++) {
      for (const Frame &frame : line.feed(bytesOf(frameOf(neutral, number, 0x08)) + R7003Tail, 30)) {
        found.push_back(frame);
      }
    }
    CHECK(found.size() >= 18);
    REQUIRE_FALSE(found.empty());
    CHECK(found.back() == frameOf(neutral, 19, 0x08));
  }
}

TEST_CASE("of S.BUS2, telemetry 2 ms behind each 04, every frame is delivered") {
  const uint8_t ends[] = {0x04, 0x14, 0x24, 0x34};
  for (const bool neutral : {false, true}) {
    for (const Bytes &telemetry : {Telemetry, Bytes{0x03, 0xC4, 0x00}, Bytes{}}) {
      Wire wire;
      Frames sent;
      for (unsigned number = 0; number < 40; number++) {
        sent.push_back(frameOf(neutral, number, ends[number % 4]));
        wire.send(sent.back());
        if (number % 4 == 0) {
          wire.pause(2000).send(telemetry).pause(10000 - 120 * telemetry.size());
        } else {
          wire.pause(12000);
        }
      }
      for (const uint32_t loopUs : Loops) {
        CAPTURE(neutral);
        CAPTURE(telemetry.size());
        CAPTURE(loopUs);
        CHECK(wire.frames(loopUs) == sent);
      }
    }
  }
}

TEST_CASE("frames with header 2F, FASSTest 26's further channels, are not delivered and cost none") {
  Wire wire;
  Frames sent;
  for (unsigned number = 0; number < 20; number++) {
    sent.push_back(neutralFrame(number));
    wire.send(sent.back()).pause(4000).send(withByte(neutralFrame(number + 100), 0, 0x2F)).pause(4000);
  }
  for (const uint32_t loopUs : Loops) {
    CAPTURE(loopUs);
    CHECK(wire.frames(loopUs) == sent);
  }
}

// A loop() of 3 ms does not see these pauses of 4 ms: to it the long frame's tail may be a damaged frame. None is wrong.
TEST_CASE("36-byte frames, FrSky's 24 channels, in between are not delivered, and cost no frame if pauses can be seen") {
  // A long frame is 0F, 33 bytes of channels, flags and end; all at 992.
  Bytes payload;
  for (unsigned group = 0; group < 3; group++) {
    payload = payload + part(neutralFrame(92), 1, 12);
  }
  const Bytes longFrame = Bytes{0x0F} + payload + Bytes{0x00, 0x00};
  REQUIRE(longFrame.size() == 36);
  for (const bool plain : {false, true}) {
    Wire wire;
    Frames sent;
    for (unsigned number = 0; number < 20; number++) {
      sent.push_back(frameOf(!plain, number, 0x00));
      wire.send(sent.back()).pause(4000).send(longFrame).pause(4000);
    }
    for (const uint32_t loopUs : Loops) {
      CAPTURE(plain);
      CAPTURE(loopUs);
      const Frames found = wire.frames(loopUs);
      if (loopUs < 3000) {
        CHECK(found == sent);
      } else {
        CHECK(found.size() >= sent.size() / 2);
        CHECK(isPartOf(found, sent));
      }
    }
  }
}

TEST_CASE("another receiver on the line later, with another kind of end byte, is refused for six frames at the most") {
  const struct {
    uint8_t before;
    uint8_t after;
    Bytes tail;
  } rows[] = {
      {0x00, 0x08, R7003Tail}, {0x00, 0x04, {}}, {0x00, 0x14, {}}, {0x08, 0x00, {}},
      {0x04, 0x00, {}},        {0x04, 0x08, R7003Tail}, {0x08, 0x04, {}},
  };
  for (const auto &row : rows) {
    for (const bool neutral : {false, true}) {
      for (const uint64_t silenceUs : {4000u, 500000u}) {
        Wire wire;
        Frames sent;
        for (unsigned number = 0; number < 5; number++) {
          wire.send(frameOf(neutral, number, row.before)).send(row.before == 0x08 ? R7003Tail : Bytes{}).pause(4000);
        }
        wire.pause(silenceUs);
        for (unsigned number = 10; number < 20; number++) {
          sent.push_back(frameOf(neutral, number, row.after));
          wire.send(sent.back()).send(row.tail).pause(4000);
        }
        for (const uint32_t loopUs : Loops) {
          CAPTURE(unsigned{row.before});
          CAPTURE(unsigned{row.after});
          CAPTURE(neutral);
          CAPTURE(silenceUs);
          CAPTURE(loopUs);
          const Frames found = wire.frames(loopUs);
          const auto first = std::find_if(found.begin(), found.end(),
                                          [&row](const Frame &frame) { return frame[24] == row.after; });
          const auto accepted = static_cast<size_t>(found.end() - first);
          CHECK(sent.size() - accepted <= 6);
          CHECK(Frames(first, found.end()) == Frames(sent.end() - static_cast<std::ptrdiff_t>(accepted), sent.end()));
        }
      }
    }
  }
}

TEST_CASE("CH16 below 128 moving or standing still, every frame is delivered") {
  for (unsigned value = 0; value < 256; value++) {
    CAPTURE(value);
    Wire wire;
    Frames sent;
    for (unsigned number = 0; number < 6; number++) {
      Channels channels = PaperLow.channels;
      channels[0] = static_cast<uint16_t>(number);
      channels[15] = static_cast<uint16_t>(value);
      sent.push_back(writeBitByBit(channels));
      wire.send(sent.back()).pause(4000);
    }
    for (const uint32_t loopUs : {50u, 3000u}) {
      CAPTURE(loopUs);
      CHECK(wire.frames(loopUs) == sent);
    }
  }
}

TEST_CASE("of every make every frame is delivered, whatever flags come and stay") {
  for (const uint8_t end : {uint8_t{0x00}, uint8_t{0x04}, uint8_t{0x08}}) {
    for (unsigned flags = 0; flags < 16; flags++) {
      Wire wire;
      Frames sent;
      for (unsigned number = 0; number < 30; number++) {
        sent.push_back(withByte(plainFrame(number, end), 23, number < 10 ? 0 : flags));
        wire.send(sent.back());
        if (end == 0x04) {
          wire.pause(2000).send(Telemetry).pause(10000 - 360);
        } else {
          wire.send(end == 0x08 ? R7003Tail : Bytes{}).pause(11000);
        }
      }
      for (const uint32_t loopUs : Loops) {
        CAPTURE(unsigned{end});
        CAPTURE(flags);
        CAPTURE(loopUs);
        const Frames found = wire.frames(loopUs);
        CHECK(found.size() == sent.size());
        CHECK(isPartOf(found, sent));
      }
    }
  }
}
