// The impaired lines: on how many of them a frame is missed, wrong, late or too young, and how many Bounds.h allows.
// FRAMES=n of each line and kind of sticks, SEED=n: the number of the day.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdio>
#include <string>

#include "Bounds.h"
#include "Settings.h"

namespace {

constexpr uint64_t Frames = 10000;

// A line as it was described for other receivers.
Tally papers(const char *condition, Payload sticks) {
  const auto found = std::find_if(conditions().begin(), conditions().end(),
                                  [condition](const Condition &one) { return one.name == condition; });
  REQUIRE(found != conditions().end());
  return impairment(*found, {{9000, 50}}, {sticks}, Decoder::Papers, 20000, seedOfDay());
}

}  // namespace

TEST_CASE("on no line more goes wrong than its rate, or its promise, allows") {
  const uint64_t frames = setting("FRAMES", Frames, 1);
  std::printf("impaired lines: seed %llu, %llu frames of each line and kind of sticks\n",
              static_cast<unsigned long long>(seedOfDay()), static_cast<unsigned long long>(frames));
  const std::vector<Group> all = groups();
  std::vector<Tally> tallies;
  for (const Group &group : all) {
    tallies.push_back(impairment(group, frames, seedOfDay()));
    INFO(group.condition->name, ", ", std::string(group.name));
    CHECK(tallies.back().intact + tallies.back().damaged > 0);
    if (group.condition->name.find("clean") != std::string::npos) {
      CHECK(tallies.back().damages() == 0);
    }
  }
  for (const Check &check : checks(all, tallies)) {
    INFO("lines on which a frame was ", check.what, ": ", check.line, check.parts);
    INFO("of ", check.seen.lines, " lines; measured: ", check.measured.count, " of ", check.measured.lines);
    INFO("SEED=", seedOfDay(), " FRAMES=", frames);
    CHECK(check.seen.count <= check.most);
  }
}

TEST_CASE("the calls that the simulation leaves out in a silence change nothing") {
  for (const Condition &condition : conditions()) {
    Condition complete = condition;
    complete.run.everyLoop = true;
    const Payload sticks = (condition.only.empty() ? ordinarySticks() : condition.only).front();
    INFO(condition.name, ", ", std::string(name(sticks)), ", seed ", seedOfDay());
    CHECK(impairment(condition, condition.setups, {sticks}, Decoder::Ours, 1000, seedOfDay()) ==
          impairment(complete, condition.setups, {sticks}, Decoder::Ours, 1000, seedOfDay()));
  }
}

TEST_CASE("the bench shows the known faults of the baseline") {
  const Tally dropped = papers("dropped 1/300", Payload::Neutral);
  CHECK(static_cast<double>(dropped.missed) > 4.0 * static_cast<double>(dropped.damaged));  // described: 6.3
  const Tally inserted = papers("inserted 1/500", Payload::Smooth);
  CHECK(static_cast<double>(inserted.wrong) > 0.7 * static_cast<double>(inserted.damaged));  // described: nine of ten
  const Tally tailed = papers("clean, R7003SB", Payload::Smooth);
  CHECK(static_cast<double>(tailed.missed) > 0.9 * static_cast<double>(tailed.intact));
  CHECK(papers("clean", Payload::Smooth).missed == 0);
}
