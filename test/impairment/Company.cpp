#include "Conditions.h"

#include "Runs.h"

namespace {

constexpr Promise Faultless = Promise::Faultless;
constexpr Promise NeverWrong = Promise::NeverWrong;

const std::vector<Setup> &sbus2() {
  static const std::vector<Setup> list = everyDriver({15000}, {50, 1000, 2000, 3100, 4000, 4900});
  return list;
}
// In these setups every gap between frames is seen.
const std::vector<Setup> &gaps() {
  static const std::vector<Setup> list = [] {
    std::vector<Setup> all = everyDriver({9000}, {50, 1000});
    const std::vector<Setup> slower = everyDriver({15000}, {50, 1000, 3000, 5000});
    all.insert(all.end(), slower.begin(), slower.end());
    return all;
  }();
  return list;
}
const std::vector<Setup> &quick() {
  static const std::vector<Setup> list = everyDriver({7000, 9000, 14000}, {20, 50});
  return list;
}

Run late(int32_t us) {
  Run run = slotsAfterEach(2);
  run.line.company.lateUs = us;
  return run;
}
Run ofOtherGroup() {
  Run run = slotsAfterEach(2);
  run.line.company.group = 1;
  return run;
}
Run before(int stray) {
  Run run;
  run.line.company.strayBefore = stray;
  return run;
}
Run after(int stray, Kind kind = Kind::Plain) {
  Run run = of(kind);
  run.line.company.strayAfter = stray;
  return run;
}

// A 00 after each transmission, as a Futaba R7008SB has it: after each frame, and after each slot or after none.
Run withBreaks(unsigned count, bool afterEach, bool afterSlots, double cutSlots = 0, double drop = 0) {
  Run run = afterEach ? slotsAfterEach(count) : slots(count);
  run.line.company.strayAfter = 0;
  run.line.company.breakAfterSlots = afterSlots;
  run.line.company.cutSlots = cutSlots;
  run.line.impairments.dropped = drop;
  return run;
}

}  // namespace

const std::vector<Condition> &companyLines() {
  static const std::vector<Condition> list = {
      {"S.BUS2, 8 slots after 04", slots(8), sbus2()},
      {"S.BUS2, 2 slots after each frame", slotsAfterEach(2), sbus2()},
      {"S.BUS2, 8 slots after each frame", slotsAfterEach(8), sbus2(), NeverWrong},
      {"S.BUS2, 2 slots after each frame, 0.5 ms late", late(500), sbus2()},
      {"S.BUS2, 2 slots after each frame, 1 ms early", late(-1000), sbus2()},
      {"S.BUS2, 2 slots of another group after each frame", ofOtherGroup(), sbus2()},
      {"S.BUS2, breaks, no slots", withBreaks(0, false, true), sbus2()},
      {"S.BUS2, breaks, no slots, dropped 1/300", withBreaks(0, false, true, 0, 1 / 300.), sbus2()},
      {"S.BUS2, breaks, 1 slot after 04", withBreaks(1, false, true), sbus2()},
      {"S.BUS2, breaks, 1 slot after 04, dropped 1/300", withBreaks(1, false, true, 0, 1 / 300.), sbus2()},
      {"S.BUS2, breaks, 2 slots after each frame", withBreaks(2, true, true), sbus2()},
      {"S.BUS2, breaks, 8 slots after each frame", withBreaks(8, true, true), sbus2()},
      {"S.BUS2, breaks, 8 slots after each frame, 1/10 of them cut", withBreaks(8, true, true, 1 / 10.), sbus2()},
      {"S.BUS2, breaks, 8 slots after each frame, dropped 1/300", withBreaks(8, true, true, 0, 1 / 300.), sbus2()},
      {"S.BUS2, a break after each frame, 1 slot after 04", withBreaks(1, false, false), sbus2()},
      {"S.BUS2, a break after each frame, 2 slots after each frame", withBreaks(2, true, false), sbus2()},
      {"FASSTest 12CH, slot 0 as it is timed", of(Kind::Fasst12), everyDriver({6300}, {50, 1000, 2000, 3000})},
      {"a character 00 straight after each frame", after(0), gaps(), NeverWrong},
      {"S.BUS2, a character 00 straight after each frame", after(0, Kind::Sbus2), gaps(), NeverWrong},
      {"any character straight after each frame", after(Company::AnyStray), gaps(), NeverWrong},
      {"a character 00 straight before each frame", before(0), gaps(), NeverWrong},
      {"any character straight before each frame", before(Company::AnyStray), gaps(), NeverWrong},
      {"delay of 1 to 5 ms every 97 ms", blocked(1, 5, 97), quick(), Faultless},
      {"unplugged for 1 period, again at the same character", cut(1), gaps(), NeverWrong},
      {"unplugged for 9 periods, again at the same character", cut(9), gaps(), NeverWrong},
  };
  return list;
}
