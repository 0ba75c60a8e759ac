#include "Conditions.h"

#include "Runs.h"

namespace {

// PendSV makes the calls of all drivers one after the other, each to its end (GrumpyOldPizza/ArduinoCore-stm32l0
// b1cf1cd, armv6m_pendsv.c:133): the UART's waits for what another one does, such as to write to an SD card.
Run late(uint32_t us, Run run = plain()) {
  run.workUs = us;
  run.workEveryUs = 60000;
  return run;
}

}  // namespace

// With lost characters, the parts of two frames may come in one call, and look like one.
const std::vector<Condition> &lateCallLines() {
  constexpr Promise None = Promise::None;
  constexpr Promise Faultless = Promise::Faultless;
  constexpr Promise NeverWrong = Promise::NeverWrong;
  static const std::vector<Setup> setups = calledBack({7000, 9000, 14000}, 40);
  static const std::vector<Condition> lines = {
      {"calls up to 40 us late", plain(), setups, Faultless},
      {"calls up to 1 ms late", late(1000), setups, Faultless},
      {"calls up to 2 ms late", late(2000), setups, NeverWrong},
      {"calls up to 8 ms late", late(8000), setups, NeverWrong},
      {"calls up to 40 us late, dropped 1/300", dropped(1 / 300.), setups, None},
      {"calls up to 1 ms late, dropped 1/300", late(1000, dropped(1 / 300.)), setups, None},
      {"calls up to 2 ms late, dropped 1/300", late(2000, dropped(1 / 300.)), setups, None},
      {"calls up to 8 ms late, dropped 1/300", late(8000, dropped(1 / 300.)), setups, None},
  };
  return lines;
}
