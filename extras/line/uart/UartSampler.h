// What a UART with the wrong settings receives: it samples the wire's levels in its own way.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>

#include "line/uart/Levels.h"

namespace line {

// Converts a wire's characters into levels, and these into the characters that a port with other settings receives. For
// a port of the wrong polarity the idle wire is active, and it finds edges inside characters. If port and wire agree,
// the characters are unchanged.
class UartSampler {
 public:
  // Opens the port at `nowUs` with these settings, and forgets everything before.
  void open(uint64_t nowUs, const LineSettings &port, const LineSettings &line) {
    _port = port;
    _line = line;
    _line.polarity = line.polarity == Polarity::Either ? port.polarity : line.polarity;
    _decoder = CharacterDecoder(port, port.bitNs());
    _decoder.level(static_cast<int64_t>(nowUs) * NsPerUs, _line.idleHigh(), _newest);
    _seen.clear();
    _knownUs = nowUs;
  }

  // Takes a character of the wire. One that began before open() is ignored.
  void put(const Character &character) {
    if (character.endUs < _knownUs + _line.characterUs()) {
      return;
    }
    encode(character, _line, [this](int64_t ns, bool high) { take(_decoder.level(ns, high, _newest)); });
    _knownUs = character.endUs;
  }

  // Takes the next character received by the port, with its end as the port sees it. Returns false without one. All
  // characters complete by `nowUs` have been put.
  bool next(uint64_t nowUs, Character &character) {
    // A character in transit has not been put yet: the time in which it may have begun is not known.
    const uint64_t knownUs = std::max(_knownUs, nowUs - std::min<uint64_t>(nowUs, _line.characterUs()));
    take(_decoder.until(static_cast<int64_t>(knownUs) * NsPerUs, _newest));
    if (_seen.empty() || _seen.front().endUs > knownUs) {
      return false;
    }
    character = _seen.front();
    _seen.pop_front();
    return true;
  }

 private:
  static constexpr int64_t NsPerUs = 1000;

  void take(bool through) {
    if (through) {
      const int64_t endNs = _newest.startNs + static_cast<int64_t>(_port.characterNs());
      _seen.push_back({static_cast<uint64_t>((endNs + NsPerUs - 1) / NsPerUs), _newest.value, _newest.bad(), 0,
                       _newest.parityWrong, _newest.stopWrong});
    }
  }

  LineSettings _line;
  LineSettings _port;
  CharacterDecoder _decoder = CharacterDecoder(_port, _port.bitNs());
  WireCharacter _newest;
  std::deque<Character> _seen;
  uint64_t _knownUs = 0;  // the end of the last character put
};

}  // namespace line
