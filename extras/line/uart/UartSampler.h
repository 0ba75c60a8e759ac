// What a UART makes of a wire that it has not been set for: it sees levels, and samples them its own way.
#pragma once

#include <cstdint>
#include <deque>

#include "line/uart/Levels.h"

namespace line {

// Characters go in as they are on the wire, in its format, and become levels. Out come the characters that a port with
// other settings takes these for. A port of the wrong polarity sees active what is idle, and finds its edges inside
// characters.
//
// Where port and wire agree, the same characters come out as went in.
class UartSampler {
 public:
  // The port was opened at `nowUs` with these settings: what was on the wire before is forgotten.
  void open(uint64_t nowUs, const LineSettings &port, const LineSettings &line);

  // A character has gone over the wire. One that had begun before open() is ignored.
  void put(const Character &character);

  // Takes the next character that the port has seen, with its end as the port sees it; false without one. `nowUs`: every
  // character that was through by then has been put.
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
