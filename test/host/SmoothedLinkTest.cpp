// The state of the link as a person can follow it: how often it changes, and for how long it is shown.
#include <doctest/doctest.h>

#include <vector>

#include "impairment/Settings.h"
#include "line/SmoothedLink.h"
#include "line/simulation/Random.h"
#include "sbus/Frame.h"

namespace {

using sbus::LinkState;

constexpr uint64_t FrameUs = 9000;

// Frames every 9 ms, looked at every millisecond.
struct Line {
  sbus::Link link;
  line::SmoothedLink held;
  uint64_t us = 0;
  std::vector<LinkState> states;  // as they change
  unsigned lit = 0;               // ms for which the indicator of lost frames shows

  void frame(uint8_t flags) {
    us += FrameUs;
    link.frame(flags);
    held.frame(us, flags, link.state(0, 0), us);
    for (uint64_t nowUs = us; nowUs < us + FrameUs; nowUs += 1000) {
      const LinkState state = held.state(link.state(0, 0), nowUs);
      if (states.empty() || states.back() != state) {
        states.push_back(state);
      }
      lit += held.showsLostFrame(nowUs);
    }
  }
};

}  // namespace

TEST_CASE("a link that loses 2 of 100 frames stays fine, one that loses 20 is lossy once") {
  const uint64_t seed = seedOfDay();
  CAPTURE(seed);
  for (unsigned number = 0; number < 100; number++) {
    line::Random random(seed + number);
    for (const auto &each : {std::pair<unsigned, size_t>{2, 4}, {10, 6}, {20, 3}}) {
      const unsigned percent = each.first;
      Line line;
      for (int i = 0; i < 1000; i++) {
        line.frame(random.below(100) < percent ? sbus::FlagLostFrame : 0);
      }
      CAPTURE(percent);
      CHECK(line.states.size() <= each.second);
    }
  }
}

TEST_CASE("a single lost frame lights its indicator for 0.2 s, and does not change the state") {
  Line line;
  for (int i = 0; i < 200; i++) {
    line.frame(i == 100 ? sbus::FlagLostFrame : 0);
  }
  CHECK(line.lit == 200);
  CHECK(line.states == std::vector<LinkState>{LinkState::Ok});
}

TEST_CASE("a lost frame that a port brought late is shown from when it came") {
  line::SmoothedLink held;
  held.frame(100000, sbus::FlagLostFrame, LinkState::Lossy, 900000);
  CHECK(held.showsLostFrame(2000000));  // as long as no other comes
  held.frame(109000, 0, LinkState::Ok, 900000);
  CHECK(held.showsLostFrame(1099000));
  CHECK_FALSE(held.showsLostFrame(1100000));
}

TEST_CASE("failsafe shows at once, by the flag and by the loss limit, and for 0.2 s more; a stale link shows at once") {
  Line line;
  line.frame(0);
  line.frame(sbus::FlagLostFrame | sbus::FlagFailsafe);
  line.frame(0);
  CHECK(line.held.state(LinkState::Ok, 2 * FrameUs + 199000) == LinkState::Failsafe);
  CHECK(line.held.state(LinkState::Ok, 2 * FrameUs + 200000) == LinkState::Ok);
  CHECK(line.held.state(LinkState::Stale, 2 * FrameUs) == LinkState::Stale);
  for (int i = 0; i < 99; i++) {
    line.frame(sbus::FlagLostFrame);
  }
  CHECK(line.states.back() == LinkState::Lossy);
  line.frame(sbus::FlagLostFrame);
  CHECK(line.states.back() == LinkState::Failsafe);
}
