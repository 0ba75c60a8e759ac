// How soon the next frame may begin: the shortest interval, whatever answers have destroyed.
#include <doctest/doctest.h>

#include <vector>

#include "line/simulation/Random.h"
#include "sbus2/FrameInterval.h"

namespace {

using Outcome = sbus::SlotSchedule::Outcome;
constexpr unsigned Pause = 16, Memory = 1024;

struct Line {
  sbus::FrameInterval interval;
  uint32_t now = 0xFFFF0000;  // the clock wraps

  Line() { interval.reset(); }
  void frame(uint32_t us, Outcome outcome = Outcome::None) {
    now += us;
    interval.frame(now, outcome);
  }
  void frames(unsigned count, uint32_t us, Outcome outcome = Outcome::None) {
    for (; count > 0; count--) {
      frame(us, outcome);
    }
  }
};

}  // namespace

TEST_CASE("before anything is answered 16 intervals are listened to; then the shortest of them holds") {
  Line line;
  line.frames(1 + Pause - 1, 15000);
  CHECK(line.interval.shortest() == 0);
  line.frame(15000);
  CHECK(line.interval.shortest() == 15000);
  Line jittering;
  line::Random random(20185);
  uint32_t shortest = UINT32_MAX;
  jittering.frame(1);
  for (unsigned i = 0; i < Memory; i++) {
    const uint32_t us = 14000 + random.below(2000);
    shortest = std::min(shortest, us);
    jittering.frame(us);
  }
  CHECK(jittering.interval.shortest() == shortest);
}

TEST_CASE("a frame whose end is not known exactly counts if it comes early in any case") {
  const auto early = [](Line &line, uint32_t us, uint32_t apart) {
    line.now += us;
    line.interval.endedBetween(line.now - apart, line.now);
  };
  Line line;
  line.frames(2 + Pause, 15000);
  early(line, 15000, 600);
  line.frame(9000);  // nothing is known of these
  CHECK(line.interval.shortest() == 15000);
  line.frame(15000);
  early(line, 14999, 600);
  CHECK(line.interval.shortest() == 14399);
  line.frames(2, 15000);
  early(line, 9000, 1000);
  CHECK(line.interval.shortest() == 8000);
  line.frames(2, 15000);
  early(line, 500, 600);
  CHECK(line.interval.shortest() == 0);
  line.frames(1 + 2 * Memory, 15000);
  CHECK(line.interval.shortest() == 15000);
}

TEST_CASE("a frame that an answer destroys makes an interval longer: the shortest stays, and it listens") {
  for (const uint32_t period : {7000u, 9000u, 11000u, 15000u, 30000u}) {
    CAPTURE(period);
    Line line;
    line.frames(2 + Pause, period);
    line.frames(100, period, Outcome::Fine);
    CHECK(line.interval.shortest() == period);
    line.frame(2 * period, Outcome::Fine);  // one frame is missing
    CHECK(line.interval.shortest() == 0);
    line.frames(Pause - 1, period);
    CHECK(line.interval.shortest() == 0);
    line.frame(period);
    CHECK(line.interval.shortest() == period);
  }
}

TEST_CASE(
    "each time that it has to listen again it listens twice as long, up to 1024 frames; after fine answers less "
    "again") {
  Line line;
  line.frames(2 + Pause, 15000);
  std::vector<unsigned> pauses;
  for (int i = 0; i < 9; i++) {
    line.frame(15000, Outcome::Collided);
    unsigned pause = 0;
    for (; line.interval.shortest() == 0; pause++) {
      line.frame(15000);
    }
    pauses.push_back(pause);
  }
  CHECK(pauses[0] == 16);
  CHECK(pauses[3] == 128);
  CHECK(pauses[6] == 1024);
  CHECK(pauses[8] == 1024);
  line.frames(5 * 64, 15000, Outcome::Fine);
  line.frame(15000, Outcome::Collided);
  line.frames(2 * Pause - 1, 15000);
  CHECK(line.interval.shortest() == 0);
  line.frames(1 + 2 * 64, 15000, Outcome::Fine);
  line.frame(15000, Outcome::Collided);
  line.frames(Pause, 15000);
  CHECK(line.interval.shortest() == 15000);
}

TEST_CASE("an interval whose beginning is not known counts nothing; after 65 ms of silence it begins afresh") {
  Line line;
  line.frames(2 + Pause, 15000);
  line.interval.missed();
  line.frame(1000, Outcome::Fine);
  CHECK(line.interval.shortest() == 15000);
  line.interval.missed();
  line.frame(45000, Outcome::Fine);
  CHECK(line.interval.shortest() == 15000);
  line.frame(65535);
  CHECK(line.interval.shortest() == 0);
  line.frames(Pause, 9000);
  CHECK(line.interval.shortest() == 9000);
}
