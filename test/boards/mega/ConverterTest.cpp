// Runs the examples that convert S.Bus to other signals and back, on a simulated Arduino Mega, and measures how far off
// the edges are.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "Expected.h"
#include "Mega.h"
#include "line/Source.h"
#include "sbus/Scaling.h"

namespace {

using mega::Expected;
using mega::Mega;
using mega::Numbers;
using mega::Pulse;

constexpr size_t PpmPin = 4;
constexpr double LeastSync = 4500;  // us
// libsimavr moves an edge to the end of the instruction that it falls into, of up to 5 cycles.
constexpr double Instruction = 0.32;  // us

mega::Line flight(uint64_t cutUs = UINT64_MAX) {
  mega::Line line;
  line.source = line::Source().open();
  line.cutUs = cutUs;
  return line;
}

Numbers ppm(const mega::SeenFrame &frame) {
  Numbers channels;
  for (size_t i = 0; i < 8 && !frame.failsafe && !frame.stale; i++) {
    channels.push_back(sbus::toMicroseconds(frame.channels[i], sbus::FrSky));
  }
  return channels;
}

// What can be off, in us: the most of each.
struct Off {
  double pulse = 0, channel = 0, period = 0;
};

}  // namespace

TEST_CASE("PpmOut: each frame has the newest channels, to 0.5 us, every 22.5 ms, and there is none in failsafe") {
  struct Run {
    std::string name;
    uint64_t cutUs;
    double seconds;
    size_t frames;                // at least
    double silentFrom, silentTo;  // us
  };
  // 9 frames of 9 ms lost, then the failsafe flag at 10 s; or nothing from 2 s on
  for (const Run &run :
       {Run{"flight", UINT64_MAX, 13, 460, 10.05e6, 12.5e6}, Run{"cut", 2000000, 3, 80, 2.13e6, 3e6}}) {
    CAPTURE(run.name);
    const Mega mega("PpmOut", flight(run.cutUs), run.seconds);
    const Expected expected(mega.characters());
    const std::vector<Pulse> &pulses = mega.pulses(PpmPin);
    std::string wrong;
    Off off;
    size_t frames = 0;
    for (size_t first = 0; first + 9 < pulses.size(); first += 9, frames++) {
      Numbers channels;
      for (size_t i = 0; i < 9; i++) {
        const Pulse &pulse = pulses[first + i];
        off.pulse = std::max(off.pulse, std::abs(pulse.widthUs - 300));
        if (i < 8) {
          const double us = pulses[first + i + 1].exactUs - pulse.exactUs;
          channels.push_back(std::round(us));
          off.channel = std::max(off.channel, std::abs(us - std::round(us)));
        }
      }
      const double beginsUs = pulses[first].exactUs;
      wrong += wrong.empty() ? expected.wrong(static_cast<uint64_t>(beginsUs) - 1000, channels, ppm, 0) : "";
      CHECK((beginsUs < run.silentFrom || beginsUs > run.silentTo));
      const double toNext = pulses[first + 9].exactUs - beginsUs;
      CHECK(pulses[first + 9].exactUs - pulses[first + 8].exactUs >= LeastSync);
      if (toNext < 40000) {
        off.period = std::max(off.period, std::abs(toNext - 22500));
      }
    }
    CHECK(wrong == "");
    CHECK(frames >= run.frames);
    CHECK(off.pulse <= Instruction);
    CHECK(off.channel <= Instruction);
    CHECK(off.period <= Instruction);
    MESSAGE("PPM of a Mega, ", run.name, ": ", frames, " frames; off at most: pulses ", off.pulse, " us, channels ",
            off.channel, " us, period ", off.period, " us");
    CHECK(mega.mistakes() == "");
  }
}
