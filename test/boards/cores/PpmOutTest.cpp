// The example PpmOut on a core, CORE, that makes the edges by an alarm, or in loop().
#include <algorithm>

#include "Cores.h"
#include "sbus/Scaling.h"

decltype(Serial1) Serial1, Serial2;
Console Serial;

using namespace cores;

namespace {

#if defined(ARDUINO_ARCH_RP2040)
constexpr bool IsPolled = false;
#else
constexpr bool IsPolled = true;
#endif
constexpr unsigned Frames = 200;
constexpr uint64_t Second = 1000000;

struct Ppm {
  std::vector<std::vector<int>> frames;  // the eight channels, us
  uint64_t endUs = 0;                    // of the last pulse
};

// Takes the pulses since `fromUs`. Pulses have 300 us, give or take `off`.
Ppm readPpm(uint64_t fromUs, int off) {
  Ppm ppm;
  uint64_t rose = 0;
  std::vector<int> channels;
  for (const sim::Level &level : world.levels) {
    if (level.us >= fromUs && level.isHigh) {
      const int us = static_cast<int>(level.us - rose);
      if (us < 4000 && rose != 0) {
        channels.push_back(us);
      } else if (!channels.empty()) {
        ppm.frames.push_back(channels);
        channels.clear();
      }
      rose = level.us;
    } else if (level.us >= fromUs && rose > ppm.endUs) {
      const int width = static_cast<int>(level.us - rose);
      CHECK(width >= 300 - off);
      CHECK(width <= 300 + off);
      ppm.endUs = level.us;
    }
  }
  if (!channels.empty()) {
    ppm.frames.push_back(channels);
  }
  return ppm;
}

void run(uint64_t us, unsigned loopUs) {
  for (const uint64_t endUs = world.nowUs + us; world.nowUs < endUs; world.pass(loopUs)) {
    loop();
  }
}

}  // namespace

TEST_CASE(
    "PpmOut: each frame has the channels of one S.Bus frame, until 100 ms after the last; a slow loop() shortens "
    "none") {
  switchOn();
#if defined(ARDUINO_ARCH_RP2040)
  sim::alarms = sim::Alarms();
#endif
  world.tickUs = 1;
  setup();
  for (const unsigned loopUs : {50u, 400u, 1500u}) {
    CAPTURE(loopUs);
    const bool isLate = IsPolled && loopUs > 500;
    const int off = isLate ? 1600 : 5;
    const uint64_t beginUs = world.nowUs;
    world.line.clear();
    world.next = 0;
    putOnLine(Frames, 100000, Core.inverts, 9000);
    const uint64_t lineEndUs = world.line.back().endUs;
    run(lineEndUs + Second - beginUs, loopUs);
    const Ppm ppm = readPpm(beginUs, off);
    CHECK(ppm.frames.size() >= (isLate ? 40 : 80));
    for (const std::vector<int> &channels : ppm.frames) {
      REQUIRE(channels.size() == 8);
      const int raw = static_cast<int>(sbus::fromMicroseconds(static_cast<int16_t>(channels[0]), sbus::FrSky));
      for (size_t i = 0; i < 8 && !isLate; i++) {
        const Channels sent = channelsOf(static_cast<unsigned>(std::max(raw, 900) - 900));
        CHECK(std::abs(channels[i] - sbus::toMicroseconds(sent[i], sbus::FrSky)) <= 2 * off);
      }
      CHECK(*std::min_element(channels.begin(), channels.end()) >= sbus::toMicroseconds(300, sbus::FrSky) - 5);
    }
    CHECK(ppm.endUs > lineEndUs + 60000);
    CHECK(ppm.endUs < lineEndUs + 100000 + 22500 + (isLate ? 40000 : 2000));
  }
  CHECK(world.crashes == 0);
}
