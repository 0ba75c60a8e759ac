#include "Setup.h"

namespace {

std::string inUs(uint32_t us) {
  return us % 1000 == 0 ? std::to_string(us / 1000) + " ms" : std::to_string(us) + " us";
}

}  // namespace

std::vector<Setup> everyDriver(std::initializer_list<uint32_t> periodsUs, std::initializer_list<uint32_t> loopsUs) {
  std::vector<Setup> setups;
  for (const Driver &driver : {Board, ByteByByte, Fifo, Esp32Told, Esp32}) {
    for (const uint32_t periodUs : periodsUs) {
      for (const uint32_t loopUs : loopsUs) {
        setups.push_back({periodUs, loopUs, driver, 256});
      }
    }
  }
  return setups;
}

std::vector<Setup> calledBack(std::initializer_list<uint32_t> periodsUs, uint32_t lateUs) {
  constexpr uint32_t LoopUs = 20000;
  std::vector<Setup> setups;
  for (const uint32_t periodUs : periodsUs) {
    setups.push_back({periodUs, LoopUs, Board, 64, Polling::Never, lateUs});
  }
  return setups;
}

std::string name(const Setup &setup) {
  return "T " + inUs(setup.periodUs) + ", loop " + inUs(setup.loopUs) + ", " + setup.driver.name + ", " +
         std::to_string(setup.buffer) +
         (setup.polling == Polling::ByEvents ? ", by events"
          : setup.callsBack()                ? ", called back"
                                             : "");
}
