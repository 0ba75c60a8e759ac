// What a UART makes of a wire that it has not been set for: it sees levels, and samples them its own way.
#pragma once

#include <cstdint>
#include <deque>

#include "Line.h"
#include "LineSettings.h"

namespace line {

// Characters go in as they are on the wire, in its format, and become levels. Out come the characters that a port with
// other settings takes these for. It waits for an edge from idle to active, looks half a bit later whether that is a
// start bit, then at the middle of each data bit, of the parity bit and of the first stop bit, as most UARTs do; a
// wrong parity or stop bit makes the character bad. Then it waits for the next such edge. A port of the wrong polarity
// sees active what is idle, and finds its edges inside characters.
//
// Where port and wire agree, the same characters come out as went in.
class UartSampler {
 public:
  // The port was opened at `nowUs` with these settings: what was on the wire before is forgotten.
  void open(uint64_t nowUs, const LineSettings &port, const LineSettings &line);

  // A character has gone over the wire. One that had begun before open() is ignored.
  void put(const Character &character);

  // The next character that the port has seen, with its end as the port sees it; false if there is none. `nowUs`: every
  // character that was through by then has been put.
  bool next(uint64_t nowUs, Character &character);

 private:
  struct Edge {
    uint64_t ns;
    bool idle;  // what the port sees from there on
  };

  void level(uint64_t ns, bool high);
  bool idleAt(uint64_t ns) const;

  LineSettings _line;
  uint32_t _bitNs = 1;
  Format _format;
  bool _flipped = false;  // the port sees active what is idle

  std::deque<Edge> _edges;
  bool _idle = true;      // what the port sees after the last edge
  uint64_t _fromNs = 0;   // a start bit is looked for from here on
  uint64_t _knownNs = 0;  // the end of the last character put
};

}  // namespace line
