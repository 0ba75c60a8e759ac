// The board on which the sketch seems to run: clock, serial ports and the wires between them, USB, EEPROM, pins.
#pragma once

#include <deque>
#include <functional>
#include <utility>

#include "BoardPort.h"
#include "Clock.h"
#include "Eeprom.h"
#include "Pins.h"
#include "PulsePins.h"
#include "SketchInput.h"
#include "SketchOutput.h"

namespace host {

// A wire from the TX pin of one of the ports to the RX pin of the same or another port.
class JumperWire : public line::Line {
 public:
  // Takes a sent character.
  void put(const line::Character &character) { _characters.push_back(character); }

  bool next(uint64_t nowUs, line::Character &character) override {
    if (_characters.empty() || _characters.front().endUs > nowUs) {
      return false;
    }
    character = _characters.front();
    _characters.pop_front();
    return true;
  }

 private:
  std::deque<line::Character> _characters;
};

class Board {
 public:
  static constexpr int PortCount = 3;

  // Returns the only board. The first call creates it, perhaps in a constructor of the sketch before main().
  static Board &instance();

  // Default: a simulated clock from 0, which the sketch's constructors see before main().
  void setClock(const Clock &clock) { _clock = clock; }
  const Clock &clock() const { return _clock; }

  BoardPort &port(int number) { return _ports[number - 1]; }  // 1..3
  SketchOutput &output() { return _output; }
  SketchInput &input() { return _input; }
  Eeprom &eeprom() { return _eeprom; }
  Pins &pins() { return _pins; }
  PulsePins &pulsePins() { return _pulsePins; }

  // Connects the TX pin of port `from` with the RX pin of port `to`.
  void connect(int from, int to);

  // Opens port `number`, without waiting for unsent bytes. Ports wired to it get the new settings.
  void open(int number, const PortSettings &settings, uint8_t *buffer = nullptr, size_t size = 0);

  // Sets the function to call whenever time has advanced, with microseconds since the program's start.
  void onTime(std::function<void(uint64_t)> callback) { _onTime = std::move(callback); }

  // Advances the time; meanwhile the ports send and receive, and the sketch's callbacks run.
  void spend(uint64_t us);

  void enableInterrupts(bool enabled) { _interruptsEnabled = enabled; }

  // Returns true inside a callback of the sketch, where the board never waits.
  bool inCallback() const { return _inCallback; }

 private:
  struct Jumper {
    int from;
    int to;
    JumperWire line;
  };

  void step(uint64_t us);
  void share(int number);
  void send(int number);

  Clock _clock;
  BoardPort _ports[PortCount];
  std::deque<Jumper> _jumpers;
  SketchOutput _output;
  SketchInput _input;
  Eeprom _eeprom;
  Pins _pins;
  PulsePins _pulsePins;
  std::function<void(uint64_t)> _onTime;
  bool _interruptsEnabled = true;
  bool _inCallback = false;
};

}  // namespace host
