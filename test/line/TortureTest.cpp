// The torture bench: what is missed and what is wrong on every line, against issue 3's bounds, or those really reached.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdio>
#include <set>
#include <string>

#include "Conditions.h"
#include "Settings.h"

namespace {

// So many frames of each condition, timing and kind of sticks. A bound per damaged frame is held against the sum of
// a group of sticks and all timings: with 1/300 dropped, 20000 damaged frames of gentle sticks and more, 100000 of
// adversarial ones. A bound of 1e-4 so means a handful of wrong frames, and one more or less does not decide.
constexpr uint64_t Frames = 60000;

// A frame whose predecessor had other flags or a low CH16 may wait (DecodeSBus.h): uniform sticks send most of them.
constexpr double Doubtful = 0.06;

// After a block of 100 characters (12 ms; Fast S.Bus: 6 ms), a buffer that holds two frames and a pause of 50
// characters or more between them.
constexpr double OutdatedAfter100 = 0.01;

std::set<std::string> heldConditions;

double base(const Tally &tally) {
  return static_cast<double>(tally.damages() != 0 ? tally.damages() : tally.intact);
}

struct Sum {
  Tally tally;
  Tally neutral;  // of these
};

Sum sumOf(const Condition &condition, const Bound &bound) {
  Sum sum;
  for (const Timing &timing : condition.timings) {
    for (const Sticks sticks : bound.sticks) {
      const Tally one = torture(condition, timing, sticks, Way::Ours, framesPerCase(Frames), seedOfAll());
      sum.tally += one;
      if (sticks == Sticks::Neutral) {
        sum.neutral += one;
      }
    }
  }
  return sum;
}

bool isClean(const Condition &condition) {
  return condition.name.find("clean") != std::string::npos || condition.name == "S.BUS2 with telemetry" ||
         condition.name == "R7003SB";
}

double outdatedBound(const Condition &condition) {
  return condition.blockUs == 100 * host::Wire{condition.baud}.characterUs() ? OutdatedAfter100 : 0;
}

void hold(const Condition &condition) {
  heldConditions.insert(condition.name);
  for (const Bound &bound : condition.bounds) {
    INFO(condition.name, ", ", std::string(name(bound.sticks.front())), " and the like, seed ", seedOfAll());
    const Sum sum = sumOf(condition, bound);
    const Tally &tally = sum.tally;
    INFO(tally.damages(), " damages, ", tally.intact, " intact frames");
    CHECK(tally.intact > 0);
    CHECK(static_cast<double>(tally.missed) <= bound.missed * base(tally));
    CHECK(static_cast<double>(tally.wrong) <= bound.wrong * base(tally));
    if (isClean(condition)) {
      CHECK(tally.damages() == 0);
      CHECK(tally.late == 0);
      CHECK(static_cast<double>(tally.lateDoubtful) <= Doubtful * base(tally));
      CHECK(sum.neutral.lateDoubtful == 0);
    }
    if (condition.blockUs != 0) {
      const auto blocked = static_cast<double>(tally.blocked);
      CHECK(blocked > 0);
      CHECK(static_cast<double>(tally.outdated) <= outdatedBound(condition) * blocked);
      CHECK(static_cast<double>(tally.outdatedDoubtful) <= Doubtful * blocked);
    }
  }
}

void holdAll(const std::string &beginning) {
  for (const Condition &condition : conditions()) {
    if (condition.name.rfind(beginning, 0) == 0) {
      hold(condition);
    }
  }
}

// One run, or, if the condition is that the port is opened midway, one for each character of a frame.
Tally simulateAll(Run run) {
  Tally sum;
  for (unsigned character = 0; character < (run.joining ? 25 : 1); character++) {
    run.joinUs = character * run.line.characterUs();
    sum += simulate(run, Way::Ours, seedOfAll() + character);
  }
  return sum;
}

// By how many frames two tallies differ, in the figure in which they differ most.
uint64_t apart(const Tally &left, const Tally &right) {
  uint64_t most = 0;
  for (const auto figure : {&Tally::damaged, &Tally::intact, &Tally::missed, &Tally::wrong, &Tally::noise, &Tally::late,
                            &Tally::lateDoubtful, &Tally::blocked, &Tally::outdated, &Tally::outdatedDoubtful}) {
    most = std::max(most, std::max(left.*figure, right.*figure) - std::min(left.*figure, right.*figure));
  }
  return most;
}

// A line as issue 3 describes it for other receivers.
Tally papers(const char *condition, Sticks sticks) {
  const auto found = std::find_if(conditions().begin(), conditions().end(),
                                  [condition](const Condition &one) { return one.name == condition; });
  REQUIRE(found != conditions().end());
  return torture(*found, {9000, 50}, sticks, Way::Papers, 20000, seedOfAll());
}

}  // namespace

TEST_CASE("a clean line: every frame, and in lock at the first look after its last byte") {
  holdAll("clean");
}

TEST_CASE("characters dropped for their parity") {
  holdAll("dropped");
}

TEST_CASE("characters inserted") {
  holdAll("inserted");
}

TEST_CASE("two bits flipped, which parity misses") {
  holdAll("two bits flipped");
}

TEST_CASE("noise in pauses") {
  holdAll("noise");
}

TEST_CASE("joining in the middle of a frame, at every character") {
  holdAll("joined");
}

TEST_CASE("S.BUS2 with telemetry") {
  holdAll("S.BUS2");
}

TEST_CASE("a R7003SB, five characters behind every frame") {
  holdAll("R7003SB");
}

TEST_CASE("2F and 36-byte frames between the frames") {
  holdAll("2F");
}

TEST_CASE("a loop() of 20 ms") {
  holdAll("loop()");
}

TEST_CASE("a loop() that blocks") {
  holdAll("blocked");
}

TEST_CASE("Fast S.Bus, at 200000 baud") {
  holdAll("Fast S.Bus");
}

// A frame here and there may come out otherwise, and adversarial ones some more behind it: what a pause is, is reckoned
// in whole microseconds. With 17 seeds up to 5 of 234 runs, of 3000 frames each, were apart, by 4 frames at the most.
TEST_CASE("Fast S.Bus, sent at 100000 baud, with all times twice as long, comes out as at 200000 baud") {
  unsigned runsOfAll = 0;
  unsigned runsApart = 0;
  Tally all;
  for (const Condition &condition : conditions()) {
    if (condition.baud != FastBaud) {
      continue;
    }
    for (const Timing &timing : condition.timings) {
      for (const Sticks sticks : allSticks()) {
        INFO(condition.name, ", ", name(timing), ", ", std::string(name(sticks)), ", seed ", seedOfAll());
        Run run = runOf(condition, timing, sticks);
        run.line.frames = run.joining ? 12 : framesPerCase(Frames) / 20;
        const Tally fast = simulateAll(run);
        const Tally slow = simulateAll(slowMotion(run));
        CHECK(apart(fast, slow) <= 5);
        runsOfAll++;
        runsApart += apart(fast, slow) != 0;
        all += fast;
      }
    }
  }
  CHECK(runsApart * 20 <= runsOfAll);
  CHECK(all.damaged > 0);
  CHECK(all.missed > 0);
  CHECK(all.late > 0);
}

TEST_CASE("every condition has been held to its bounds") {
  for (const Condition &condition : conditions()) {
    CAPTURE(condition.name);
    CHECK(heldConditions.count(condition.name) == 1);
  }
}

TEST_CASE("the bench shows the faults of the paper's way that are known from elsewhere") {
  const Tally dropped = papers("dropped 1/300", Sticks::Neutral);
  CHECK(static_cast<double>(dropped.missed) > 4.0 * static_cast<double>(dropped.damaged));  // issue 3: 6.3
  const Tally inserted = papers("inserted 1/500", Sticks::Smooth);
  CHECK(static_cast<double>(inserted.wrong) > 0.7 * static_cast<double>(inserted.damaged));  // issue 3: nine of ten
  CHECK(papers("R7003SB", Sticks::Smooth).missed > 19900);
  CHECK(papers("clean", Sticks::Smooth).missed == 0);
}
