// Runs a sensor whose sketch disables interrupts at random, on a simulated Arduino Mega and an S.BUS2 line: three
// characters stay together, and nothing is sent at a wrong time.
#include <doctest/doctest.h>

#include <memory>
#include <random>
#include <string>
#include <utility>

#include "AvrBoard.h"
#include "Expected.h"
#include "line/simulation/SimulatedBus.h"

namespace {

using avr::AvrBoard;

constexpr double Seconds = 12;

struct Run {
  uint16_t longestUs, apartUs;  // of Masked.cpp
  bool isUnsteady;              // frames come early, or the interval changes
  unsigned long least;          // right answers
};

// 15 ms, but after some time each fourth frame comes 1 to 9 ms early.
uint32_t unsteady(std::minstd_rand &random, unsigned frame) {
  return frame > 400 && random() % 4 == 0 ? 14000 - static_cast<uint32_t>(random() % 8000) : 15000;
}

}  // namespace

TEST_CASE("interrupts disabled at random, and frames that come early: answers are whole, in time, and meet no frame") {
  const Run runs[] = {
      {60, 3000, false, 4000},  {200, 3000, false, 3000}, {500, 3000, false, 200},  {500, 20000, false, 2000},
      {5000, 50000, false, 50}, {60, 3000, true, 2000},   {500, 20000, true, 1000}, {5000, 50000, true, 10},
  };
  for (const Run &run : runs) {
    CAPTURE(run.longestUs);
    CAPTURE(run.apartUs);
    CAPTURE(run.isUnsteady);
    auto source = std::make_unique<line::SimulatedBus>();
    const line::SimulatedBus &bus = *source;
    std::minstd_rand random{20181};
    unsigned frame = 0;
    if (run.isUnsteady) {
      source->pace([&] { return unsteady(random, ++frame); });
    }
    avr::Line line;
    line.source = std::move(source);
    line.isShared = true;
    const auto low = [](unsigned number) { return static_cast<uint8_t>(number); };
    const AvrBoard board(avr::Mega, "Masked", std::move(line), Seconds,
                         {low(run.longestUs), low(run.longestUs >> 8), low(run.apartUs), low(run.apartUs >> 8)});
    MESSAGE(run.longestUs, " us masked, ", run.apartUs, " us apart, ",
            std::string(run.isUnsteady ? "unsteady: " : "steady: "), bus.judge().text(), "; at most ",
            bus.judge().mostOffUs(), "; ", board.printed().back().text);
    const avr::Numbers last = avr::numbersIn(board.printed().back().text);  // frames, sent, skipped, collisions
    if (!run.isUnsteady) {  // in quarters: each change of the code shifts it by a tenth
      const double share = last[1] / (last[1] + last[2]);
      avr::figure("`SBus2Sensor` (mega), interrupts off for up to " + std::to_string(run.longestUs) +
                      " us, on average each " + avr::rounded(run.apartUs / 2000.0, 1) + " ms: answers sent",
                  share > 0.5    ? "more than half"
                  : share > 0.25 ? "a quarter to a half"
                                 : "less than a quarter");
    }
    const line::BusJudge::Counts &counts = bus.judge().counts();
    CHECK(counts.wrong() - counts.late - counts.unseen == 0);
    CHECK(bus.judge().mostOffUs() <= 100);
    CHECK(counts.cut == 0);
    CHECK(counts.met + counts.unseen <= 20);
    CHECK(counts.right >= run.least);
    // What the core hands over while interrupts are off is lost, and that is all.
    CHECK(board.mistakes().find("sends") == std::string::npos);
  }
}
