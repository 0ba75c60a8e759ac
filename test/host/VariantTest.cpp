// A line that changes its variant: a receiver is set to another mode, or swapped.
#include <doctest/doctest.h>

#include <string>

#include "impairment/ImpairedLine.h"
#include "impairment/Settings.h"
#include "line/Observer.h"

namespace {

struct Variant {
  const char *name;
  Kind kind;
  unsigned channels;
};
constexpr Variant Variants[] = {{"S.Bus", Kind::Plain, 16},
                                {"S.BUS2", Kind::Sbus2, 16},
                                {"R7003SB", Kind::R7003SB, 16},
                                {"FASSTest 26", Kind::With2F, 32},
                                {"24 channels", Kind::Channels24, 24}};
constexpr uint64_t PeriodUs = 15000;

// Puts `seconds` of a line into the observer, from `us` on. Returns when it ended.
uint64_t play(line::Observer &observer, const Variant &variant, unsigned seconds, uint64_t us, uint32_t lateUs,
              line::Random &random) {
  Transmission sent;
  sent.sticks = Payload::Smooth;
  sent.kind = variant.kind;
  sent.periodUs = PeriodUs;
  sent.frames = seconds * 1000000 / PeriodUs;
  sent.company.slots = variant.kind == Kind::Sbus2 ? 2 : 0;
  ImpairedLine line(sent, us, random);
  for (line::Character character; line.nextUs() != UINT64_MAX; observer.put(character)) {
    us = line.nextUs();
    line.next(us, character);
    character.lateUs = lateUs;
  }
  return us;
}

}  // namespace

TEST_CASE("a line that changes its variant has it a second later, and is fine, however long it was another") {
  const uint64_t seed = seedOfDay();
  CAPTURE(seed);
  for (const Variant &before : Variants) {
    for (const Variant &after : Variants) {
      for (const uint32_t lateUs : {0u, 18000u}) {
        CAPTURE(std::string(before.name));
        CAPTURE(std::string(after.name));
        CAPTURE(lateUs);
        line::Random random(seed);
        line::Observer observer;
        uint64_t us = play(observer, before, 60, 20000, lateUs, random);
        const sbus::Counters counters = observer.counters();
        us = play(observer, after, 1, us + 50000, lateUs, random);
        CHECK(observer.newest().count == after.channels);
        const line::Values &newest = observer.newest();  // one frame in fifty has any flags
        CHECK(observer.state(us) == (newest.failsafe    ? sbus::LinkState::Failsafe
                                     : newest.lostFrame ? sbus::LinkState::Lossy
                                                        : sbus::LinkState::Ok));
        CHECK(observer.counters().frames >= counters.frames + 30);
        CHECK(observer.counters().frames <= counters.frames + 70);
      }
    }
  }
}

TEST_CASE("of a line of any variant the first frame counts, too") {
  for (const Variant &variant : Variants) {
    CAPTURE(std::string(variant.name));
    line::Random random(seedOfDay());
    line::Observer observer;
    play(observer, variant, 1, 20000, 0, random);
    observer.finish();
    CHECK(observer.counters().frames == 1000000 / PeriodUs);
  }
}
