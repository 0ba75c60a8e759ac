// Frames that had to wait for what follows, and frames that nothing near them confirms.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>

#include "KnownFrames.h"
#include "sbus/Receiver.h"

namespace {

// Feeds bytes that were read in one look at `now`; counts the frames.
unsigned look(sbus::Receiver &receiver, const uint8_t *bytes, int size, uint32_t now) {
  unsigned frames = 0;
  for (int at = 0; at < size;) {
    const int count = std::min(receiver.room(), size - at);
    std::memcpy(receiver.space(), bytes + at, static_cast<size_t>(count));
    at += count;
    if (receiver.received(count, size - at, now)) {
      frames++;
    }
  }
  return frames;
}

}  // namespace

TEST_CASE("a frame that waited is as old as the look that brought its last byte") {
  Channels low{};  // CH16 below 128: each frame behind the first waits
  uint8_t frame[25];
  sbus::pack(frame, low.data(), false, false);
  sbus::Receiver receiver;
  receiver.reset(0, 120);
  uint32_t now = 10000;
  CHECK(look(receiver, frame, 25, now) == 1);
  now += 9000;
  CHECK(look(receiver, frame, 25, now) == 0);
  const uint8_t noise = 0x55;
  CHECK(look(receiver, &noise, 1, now + 10000000) == 1);
  CHECK(receiver.frameTime() == now);
}

TEST_CASE("an R7003SB line is found behind a break even if no pause can be seen") {
  uint8_t burst[30] = {};
  std::copy(Neutral.bytes.begin(), Neutral.bytes.end(), burst);
  const uint8_t tail[] = {0x08, 0x00, 0x03, 0xC0, 0x33, 0x00};
  std::copy(std::begin(tail), std::end(tail), burst + 24);
  sbus::Receiver receiver;
  receiver.reset(0, 120);
  receiver.broken();
  unsigned frames = 0;
  for (uint32_t number = 1; number <= 20; number++) {
    frames += look(receiver, burst, 30, 3600 * number);
  }
  CHECK(frames >= 18);
}
