// When the host's board hands over received characters.
#include <doctest/doctest.h>

#include "SerialConfig.h"
#include "board/BoardPort.h"
#include "stm32l0_uart.h"

namespace {

// Characters whose ends are this many us apart.
class EvenLine : public line::Line {
 public:
  EvenLine(unsigned count, uint64_t apartUs) : _left(count), _apartUs(apartUs) {}

  bool next(uint64_t nowUs, line::Character &character) override {
    if (_left == 0 || _endUs > nowUs) {
      return false;
    }
    character = {_endUs, 0x55, false};
    _endUs += _apartUs;
    _left--;
    return true;
  }

 private:
  unsigned _left;
  const uint64_t _apartUs;
  uint64_t _endUs = 1000;
};

}  // namespace

TEST_CASE(
    "characters are handed over when 16 have come, or the line is idle for one: not while the next one comes in") {
  const struct {
    uint64_t apartUs;
    int afterThree, afterSixteen;  // when the last of them is complete, and 120 us later
  } rows[] = {{120, 0, 16}, {160, 0, 16}, {239, 0, 16}, {240, 3, 16}, {300, 3, 16}};
  for (const auto &row : rows) {
    INFO(row.apartUs, " us from character to character");
    EvenLine line(20, row.apartUs);
    host::BoardPort port;
    port.attach(line, {});
    port.open(0, host::portSettings(100000, SERIAL_SBUS));
    for (uint64_t nowUs = 0; nowUs < 1000 + 3 * row.apartUs; nowUs += 10) {
      port.receive(nowUs);
      if (nowUs < 1000 + 120) {
        CHECK(port.uart().available() == 0);
      }
    }
    CHECK(port.uart().available() == row.afterThree);
    port.receive(1000 + 15 * row.apartUs + 119);
    CHECK(port.uart().available() == row.afterSixteen);
    port.receive(1000 + 19 * row.apartUs + 119);
    CHECK(port.uart().available() == (row.afterThree == 0 ? 16 : 19));
    port.receive(1000 + 19 * row.apartUs + 120);
    CHECK(port.uart().available() == 20);
  }
}

TEST_CASE("the port knows that onReceive() has replaced another listener, not if one came again or had gone before") {
  const int first = 0, second = 0;
  host::BoardPort port;
  port.onReceive([] {}, &first);
  port.onReceive([] {}, &first);
  port.onReceive({}, nullptr);
  port.onReceive([] {}, &second);
  CHECK_FALSE(port.changedListener());
  port.onReceive([] {}, &first);
  CHECK(port.changedListener());
}
