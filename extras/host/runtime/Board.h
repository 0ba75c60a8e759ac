// The board that the sketch believes to run on: clock, serial ports, USB.
#pragma once

#include <functional>
#include <utility>

#include "Clock.h"
#include "Port.h"
#include "SketchOutput.h"

namespace host {

class Board {
 public:
  static constexpr int PortCount = 3;

  // There is one. It is made when first asked for, be it by a constructor of the sketch before main().
  static Board &instance();

  // Until it is set, a simulated clock from 0 runs: objects that the sketch constructs before main() see that one.
  void setClock(const Clock &clock) { _clock = clock; }
  const Clock &clock() const { return _clock; }

  Port &port(int number) { return _ports[number - 1]; }  // 1..3
  SketchOutput &output() { return _output; }

  // Called whenever time has gone on, with microseconds since the program's start.
  void onTime(std::function<void(uint64_t)> callback) { _onTime = std::move(callback); }

  // Time goes on, and while it does the ports receive and the sketch's callbacks run.
  void spend(uint64_t us);

  void enableInterrupts(bool enabled) { _interruptsEnabled = enabled; }

 private:
  void step(uint64_t us);

  Clock _clock;
  Port _ports[PortCount];
  SketchOutput _output;
  std::function<void(uint64_t)> _onTime;
  bool _interruptsEnabled = true;
  bool _inCallback = false;
};

}  // namespace host
