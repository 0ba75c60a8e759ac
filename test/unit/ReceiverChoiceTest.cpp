// Who flies, by tables of states and times; the pupil's channels; whose range is another one.
#include <doctest/doctest.h>

#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "sbus/Frame.h"
#include "sbus/ReceiverChoice.h"
#include "sbus/Trainer.h"

namespace {

using sbus::LinkState;
using sbus::Reception;

constexpr uint32_t StepMs = 10;

// Reads "ok", "ok 90", "lossy 50", "failsafe", "stale", "never", or "old": Ok, but its newest frame is 100 ms old.
Reception receptionOf(const std::string &text) {
  const size_t space = text.find(' ');
  const std::string state = text.substr(0, space);
  const auto percent = static_cast<uint8_t>(space == text.npos ? 100 : std::atoi(text.c_str() + space));
  return state == "ok"         ? Reception{LinkState::Ok, 5, percent}
         : state == "lossy"    ? Reception{LinkState::Lossy, 5, percent}
         : state == "failsafe" ? Reception{LinkState::Failsafe, 5, 0}
         : state == "stale"    ? Reception{LinkState::Stale, 200, 0}
         : state == "old"      ? Reception{LinkState::Ok, 100, 100}
                               : Reception{LinkState::NeverSeen, 4294967295UL, 0};
}

// The receivers from a time on.
struct Stretch {
  uint32_t fromMs;
  std::vector<std::string> receivers;
};

// Returns "1@0 0@1100 ": who flies, and since when.
template <uint8_t Count>
std::string fliesIn(const std::vector<Stretch> &stretches, uint32_t untilMs, sbus::ReceiverChoice<Count> &choice,
                    uint32_t startMs = 0) {
  std::string flies;
  size_t at = 0;
  for (uint32_t ms = 0, flying = 255; ms < untilMs; ms += StepMs) {
    at += at + 1 < stretches.size() && stretches[at + 1].fromMs <= ms;
    Reception now[Count];
    for (uint8_t i = 0; i < Count; i++) {
      now[i] = receptionOf(stretches[at].receivers[i]);
    }
    const uint8_t chosen = choice.choose(now, startMs + ms);
    CHECK(chosen == choice.flying());
    if (chosen != flying) {
      flies += std::to_string(chosen) + "@" + std::to_string(ms) + " ";
      flying = chosen;
    }
  }
  return flies;
}

}  // namespace

TEST_CASE("of two receivers the right one flies, from the right time on") {
  struct Case {
    const char *what;
    std::vector<Stretch> stretches;
    std::string flies;
    unsigned changes;
  };
  const Case cases[] = {
      {"both well: the first", {{0, {"ok", "ok"}}}, "0@0 ", 0},
      {"neither was ever seen", {{0, {"never", "never"}}}, "0@0 ", 0},
      {"only the second was ever seen: at once, and that is no change", {{0, {"never", "ok"}}}, "1@0 ", 0},
      {"the first wakes a little later: at once, and that is no change",
       {{0, {"never", "ok"}}, {990, {"ok", "ok"}}},
       "1@0 0@990 ",
       0},
      {"but only once",
       {{0, {"never", "ok"}}, {500, {"ok", "ok"}}, {600, {"stale", "ok"}}, {700, {"ok", "ok"}}},
       "1@0 0@500 1@600 0@1700 ",
       2},
      {"and only if it is as good", {{0, {"never", "ok"}}, {500, {"lossy 90", "ok"}}}, "1@0 ", 0},
      {"the first wakes later: after BackTime", {{0, {"never", "ok"}}, {1000, {"ok", "ok"}}}, "1@0 0@2000 ", 1},
      {"failsafe is left at once", {{0, {"ok", "ok"}}, {2000, {"failsafe", "ok"}}}, "0@0 1@2000 ", 1},
      {"so is a stale one", {{0, {"ok", "ok"}}, {2000, {"stale", "ok"}}}, "0@0 1@2000 ", 1},
      {"and one that begin() has made forget", {{0, {"ok", "ok"}}, {2000, {"never", "ok"}}}, "0@0 1@2000 ", 1},
      {"one in failsafe that is seen first has not flown",
       {{0, {"never", "failsafe"}}, {10, {"ok", "failsafe"}}},
       "1@0 0@10 ",
       0},
      {"nor has one while the first is stale",
       {{0, {"ok", "ok"}}, {2000, {"stale", "failsafe"}}, {3000, {"ok", "failsafe"}}},
       "0@0 1@2000 0@3000 ",
       1},
      {"and a frame of 100 ms, whatever setTimeout() says",
       {{0, {"ok", "ok"}}, {2000, {"old", "ok"}}},
       "0@0 1@2000 ",
       1},
      {"also for a lossy one", {{0, {"ok", "ok"}}, {2000, {"failsafe", "lossy 50"}}}, "0@0 1@2000 ", 1},
      {"and also within BackTime of the last change",
       {{0, {"ok", "ok"}}, {2000, {"failsafe", "ok"}}, {2100, {"ok", "failsafe"}}},
       "0@0 1@2000 0@2100 ",
       2},
      {"both in failsafe: no change", {{0, {"ok", "ok"}}, {2000, {"failsafe", "failsafe"}}}, "0@0 ", 0},
      {"one in failsafe rather than a stale one, which cannot say it",
       {{0, {"ok", "ok"}}, {2000, {"stale", "failsafe"}}},
       "0@0 1@2000 ",
       1},
      {"a stale one rather than one that was never seen", {{0, {"never", "stale"}}}, "1@0 ", 0},
      {"both stale, then both well: the one that flew last; the first after BackTime",
       {{0, {"failsafe", "ok"}}, {1500, {"stale", "stale"}}, {1800, {"ok", "ok"}}},
       "1@0 0@2800 ",
       1},
      {"lost frames: left once the other has been better for BetterTime",
       {{0, {"ok", "ok"}}, {2000, {"lossy 90", "ok"}}},
       "0@0 1@2100 ",
       1},
      {"not for less than Margin", {{0, {"ok", "ok"}}, {2000, {"lossy 91", "ok"}}}, "0@0 ", 0},
      {"nor for less than BetterTime",
       {{0, {"ok", "ok"}},
        {2000, {"lossy 50", "ok"}},
        {2090, {"ok", "ok"}},
        {2100, {"lossy 50", "ok"}},
        {2190, {"ok", "ok"}}},
       "0@0 ",
       0},
      {"not for one that is as bad", {{0, {"ok", "ok"}}, {2000, {"lossy 40", "lossy 45"}}}, "0@0 ", 0},
      {"back once it has been as good for BackTime",
       {{0, {"ok", "ok"}}, {2000, {"lossy 50", "ok"}}, {3000, {"ok", "ok"}}},
       "0@0 1@2100 0@4000 ",
       2},
      {"a lost frame begins that time again",
       {{0, {"ok", "ok"}},
        {2000, {"lossy 50", "ok"}},
        {3000, {"ok", "ok"}},
        {3900, {"lossy 99", "ok"}},
        {3910, {"ok", "ok"}}},
       "0@0 1@2100 0@4910 ",
       2},
      {"so does a time in failsafe",
       {{0, {"failsafe", "ok"}}, {1000, {"ok", "ok"}}, {1900, {"failsafe", "ok"}}, {1910, {"ok", "ok"}}},
       "1@0 0@2910 ",
       1},
      {"in that time the second may be lossy", {{0, {"failsafe", "ok"}}, {1000, {"ok", "lossy 50"}}}, "1@0 0@2000 ", 1},
      {"no second change within BackTime, though the other is better by far",
       {{0, {"ok", "ok"}}, {2000, {"lossy 50", "ok"}}, {2110, {"ok", "lossy 10"}}},
       "0@0 1@2100 0@3110 ",
       2},
      {"from the first call on, without waiting for a clock",
       {{0, {"lossy 50", "ok"}}, {100, {"ok", "ok"}}},
       "0@0 ",
       0},
  };
  for (const Case &each : cases) {
    for (const uint32_t startMs : {uint32_t{0}, uint32_t{1000000}, UINT32_MAX - 2500}) {  // the clock wraps in the last
      CAPTURE(each.what);
      CAPTURE(startMs);
      sbus::ReceiverChoice<2> choice;
      const std::string flies = fliesIn<2>(each.stretches, 6000, choice, startMs);
      CHECK(flies == each.flies);
      CHECK(choice.changes() == each.changes);
    }
  }
}

TEST_CASE("of three receivers the best one flies, of equal ones the earliest") {
  struct Case {
    std::vector<Stretch> stretches;
    std::string flies;
  };
  const Case cases[] = {
      {{{0, {"ok", "ok", "ok"}}, {2000, {"stale", "ok", "ok"}}}, "0@0 1@2000 "},
      {{{0, {"ok", "ok", "ok"}}, {2000, {"stale", "lossy 90", "lossy 91"}}}, "0@0 2@2000 "},
      {{{0, {"ok", "ok", "ok"}}, {2000, {"lossy 50", "ok 80", "ok 90"}}}, "0@0 2@2100 "},
      {{{0, {"ok", "ok", "ok"}}, {2000, {"lossy 50", "ok 90", "ok 80"}}}, "0@0 1@2100 "},
      {{{0, {"ok", "ok", "ok"}}, {2000, {"lossy 50", "ok 90", "ok 90"}}}, "0@0 1@2100 "},
      {{{0, {"ok", "ok", "ok"}},
        {2000, {"failsafe", "failsafe", "ok"}},
        {3000, {"failsafe", "ok", "ok"}},
        {5000, {"ok", "ok", "ok"}}},
       "0@0 2@2000 1@4000 0@6000 "},
      {{{0, {"never", "never", "failsafe"}}, {500, {"never", "lossy 10", "failsafe"}}}, "2@0 1@500 "},
  };
  for (const Case &each : cases) {
    CAPTURE(each.flies);
    sbus::ReceiverChoice<3> choice;
    CHECK(fliesIn<3>(each.stretches, 7000, choice) == each.flies);
  }
}

TEST_CASE("receivers of two makes are told by the channels that rest") {
  // Where CH1 to CH16 stand: a number of channels at FrSky's centre, others at Futaba's, the rest elsewhere.
  const auto frame = [](unsigned atFrSkys, unsigned atFutabas) {
    std::vector<uint16_t> channels(18, 500);
    for (unsigned i = 0; i < atFrSkys + atFutabas; i++) {
      channels[i] = static_cast<uint16_t>((i < atFrSkys ? 992 : 1024) + static_cast<int>(i % 3) - 1);
    }
    return channels;
  };
  struct Case {
    unsigned one[2], other[2];
    bool haveOther;
  };
  const Case cases[] = {
      {{12, 0}, {0, 12}, true},  {{0, 4}, {4, 0}, true},    {{12, 0}, {12, 0}, false}, {{0, 12}, {0, 12}, false},
      {{12, 0}, {1, 12}, false}, {{12, 1}, {0, 12}, false}, {{3, 0}, {0, 12}, false},  {{12, 0}, {0, 3}, false},
      {{0, 0}, {0, 12}, false},  {{12, 0}, {0, 0}, false},
  };
  for (const Case &each : cases) {
    CAPTURE(each.one[0]);
    CAPTURE(each.other[1]);
    const std::vector<uint16_t> one = frame(each.one[0], each.one[1]), other = frame(each.other[0], each.other[1]);
    CHECK(sbus::haveOtherRanges(one.data(), other.data()) == each.haveOther);
    CHECK(sbus::haveOtherRanges(other.data(), one.data()) == each.haveOther);
  }
  const SBusFrame none;
  CHECK_FALSE(sbus::haveOtherRanges(none.channels, frame(0, 12).data()));
}

TEST_CASE("the pupil has the channels that the teacher hands over, while both are received") {
  // CH8 is the switch, and CH1, CH2 and CH16 are handed over.
  struct Step {
    uint32_t ms;
    const char *teacher;
    uint16_t toggle;
    const char *pupil;
    bool flies;
  };
  const Step steps[] = {
      {10, "ok", 1811, "ok", true},         {20, "ok", 992, "ok", false},  // the middle of three positions
      {30, "ok", 1401, "ok", false},                                       // +50 %
      {40, "ok", 1402, "ok", true},         {50, "lossy 90", 1811, "ok", true},
      {60, "failsafe", 1811, "ok", false},  // the teacher's failsafe is sent
      {70, "ok", 1811, "ok", true},         {80, "ok", 1811, "failsafe", false},
      {90, "ok", 1811, "lossy 90", false},  // after failsafe the pupil needs a frame of its own
      {100, "ok", 1811, "ok", true},        // its newest frame came at 95 ms
      {150, "ok", 1811, "lossy 90", true},  {194, "ok", 1811, "lossy 80", true},
      {195, "ok", 1811, "lossy 80", false}, {200, "ok", 1811, "ok", true},
      {210, "ok", 1811, "stale", false},    {220, "ok", 1811, "never", false},
      {230, "stale", 1811, "ok", false},    {240, "never", 1811, "ok", false},
      {250, "ok", 1811, "old", false},      {260, "ok", 1811, "ok", true},
  };
  for (const uint32_t startMs : {uint32_t{0}, UINT32_MAX - 120}) {
    sbus::Trainer trainer(7, 0x8003, sbus::FrSky);
    for (const Step &step : steps) {
      CAPTURE(step.ms);
      uint16_t frame[18], pupils[18];
      for (uint16_t i = 0; i < 18; i++) {
        frame[i] = static_cast<uint16_t>(100 + i);
        pupils[i] = static_cast<uint16_t>(200 + i);
      }
      frame[7] = step.toggle;
      trainer.hear(receptionOf(step.pupil), startMs + step.ms);
      CHECK(trainer.train(frame, receptionOf(step.teacher), pupils) == step.flies);
      for (uint16_t i = 0; i < 18; i++) {
        const bool isHanded = step.flies && (i < 2 || i == 15);
        CHECK(frame[i] == (isHanded ? 200 + i : i == 7 ? step.toggle : 100 + i));
      }
    }
  }
}

TEST_CASE("a teacher's switch with a reversed range is on at +100 %") {
  sbus::Trainer trainer(7, 1, {1811, 992, 172});
  uint16_t frame[18] = {}, pupils[18] = {5};
  frame[7] = 1811;
  trainer.hear(receptionOf("ok"), 10);
  CHECK_FALSE(trainer.train(frame, receptionOf("ok"), pupils));
  frame[7] = 172;
  CHECK(trainer.train(frame, receptionOf("ok"), pupils));
  CHECK(frame[0] == 5);

  sbus::Trainer even(7, 1, {0, 1000, 2000});
  even.hear(receptionOf("ok"), 10);
  frame[7] = 1500;  // +50 % exactly
  CHECK_FALSE(even.train(frame, receptionOf("ok"), pupils));
}
