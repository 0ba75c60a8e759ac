#include "Board.h"

namespace host {

namespace {

constexpr uint64_t StepUs = 100;  // shorter than a character: in a long delay() callbacks come when they are due

}  // namespace

Board &Board::instance() {
  static Board board;
  return board;
}

void Board::spend(uint64_t us) {
  for (; us > StepUs; us -= StepUs) {
    step(StepUs);
  }
  step(us);
}

void Board::step(uint64_t us) {
  _clock.spend(us);
  for (Port &port : _ports) {
    port.receive(_clock.nowUs());
  }
  // A callback may look at a port or at the clock, and so come here again: it does not interrupt itself.
  if (_interruptsEnabled && !_inCallback) {
    _inCallback = true;
    for (Port &port : _ports) {
      port.callBack();
    }
    _inCallback = false;
  }
  if (_onTime) {
    _onTime(_clock.nowUs());
  }
}

}  // namespace host
