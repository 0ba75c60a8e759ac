// What a UART with the wrong settings receives: it samples the wire's levels in its own way.
#pragma once

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
  void open(uint64_t nowUs, const LineSettings &port, const LineSettings &line);

  // Takes a character of the wire. One that began before open() is ignored.
  void put(const Character &character);

  // Takes the next character received by the port, with its end as the port sees it. Returns false without one. All
  // characters complete by `nowUs` have been put.
  bool next(uint64_t nowUs, Character &character);

 private:
  void take(bool through);

  LineSettings _line;
  LineSettings _port;
  CharacterDecoder _decoder = CharacterDecoder(_port, _port.bitNs());
  WireCharacter _newest;
  std::deque<Character> _seen;
  uint64_t _knownUs = 0;  // the end of the last character put
};

}  // namespace line
