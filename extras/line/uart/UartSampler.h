// What a UART makes of a wire that it has not been set for: it sees levels, and samples them its own way.
#pragma once

#include <cstdint>
#include <deque>

#include "line/uart/Levels.h"

namespace line {

// Turns characters of a wire into its levels, and these into the characters that a port with other settings receives. To
// a port of the wrong polarity the idle wire is active, and it finds its edges inside characters. If port and wire agree,
// the characters come out unchanged.
class UartSampler {
 public:
  // Opens the port at `nowUs` with these settings, and forgets what was on the wire before.
  void open(uint64_t nowUs, const LineSettings &port, const LineSettings &line);

  // Takes a character of the wire. One that had begun before open() is ignored.
  void put(const Character &character);

  // Takes the next character that the port has seen, with its end as the port sees it; returns false without one.
  // `nowUs`: all characters complete by then have been put.
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
