#include "Board.h"

#include <algorithm>

namespace host {

namespace {

constexpr uint64_t StepUs = 50;  // shorter than a character, also at 200000 baud

}  // namespace

Board &Board::instance() {
  static Board board;
  return board;
}

void Board::connect(int from, int to) {
  Jumper &jumper = _jumpers.emplace_back();
  jumper.from = from;
  jumper.to = to;
  const bool sends = port(from).transmitter().isOpen();  // a constructor in the sketch may have opened it
  port(to).attach(jumper.line, sends ? port(from).settings().tx : line::LineSettings());
}

void Board::open(int number, const PortSettings &settings, uint8_t *buffer, size_t size) {
  port(number).open(_clock.nowUs(), settings, buffer, size);
  for (const Jumper &jumper : _jumpers) {
    if (jumper.from == number && port(number).transmitter().isOpen()) {
      port(jumper.to).rewire(_clock.nowUs(), settings.tx);
    }
  }
}

void Board::spend(uint64_t us) {
  uint64_t left = us;
  do {
    // Run callbacks when they are due.
    const uint64_t nowUs = _clock.nowUs();
    uint64_t nextUs = std::min(nowUs + StepUs, _pulsePins.nextUs());
    for (BoardPort &port : _ports) {
      nextUs = port.isUsed() ? std::min(nextUs, port.nextUs(nowUs)) : nextUs;
    }
    const uint64_t now = std::min(left, std::max(nextUs, nowUs + 1) - nowUs);
    step(now);
    left -= now;
  } while (left > 0);
}

void Board::step(uint64_t us) {
  _clock.spend(us);
  for (int number = 1; number <= PortCount; number++) {
    if (port(number).isUsed()) {
      share(number);
      send(number);
    }
  }
  for (BoardPort &port : _ports) {
    if (port.isUsed()) {
      port.receive(_clock.nowUs());
    }
  }
  _pulsePins.advance(_clock.nowUs());
  // A callback may poll a port or read the clock, and get here again: it does not interrupt itself.
  if (_interruptsEnabled && !_inCallback) {
    _inCallback = true;
    _pulsePins.callBack();
    for (BoardPort &port : _ports) {
      port.callBack();
    }
    _inCallback = false;
  }
  if (_onTime) {
    _onTime(_clock.nowUs());
  }
}

// Passes each character, at its start, to a line that shares the wire.
void Board::share(int number) {
  line::Character character;
  while (port(number).sender().begun(_clock.nowUs(), character)) {
    port(number).shareWire(character);
  }
}

// Sends the characters over all wires connected to the pin.
void Board::send(int number) {
  line::Character character;
  while (port(number).sender().next(_clock.nowUs(), character)) {
    for (Jumper &jumper : _jumpers) {
      if (jumper.from == number) {
        jumper.line.put(character);
      }
    }
  }
}

}  // namespace host
