// Characters out of the levels of a wire.
#pragma once

#include <cstdint>

#include "../LineSettings.h"

namespace line {

struct WireCharacter {
  int64_t startNs = 0;  // where its start bit begins
  uint8_t value = 0;
  bool parityWrong = false;
  bool stopWrong = false;  // a framing error: the first stop bit is not idle

  bool bad() const { return parityWrong || stopWrong; }
};

// It works as most UARTs do: an edge from idle to active begins a character, unless the line is idle again at the
// middle of the start bit. Each bit is sampled at its middle; the first stop bit ends the character. 8 data bits, even
// parity.
class CharacterDecoder {
 public:
  CharacterDecoder(Polarity polarity, double bitNs)
      : _idleHigh(polarity == Polarity::Uninverted), _bitNs(bitNs), _halfBitNs(bitNs / 2) {}

  // From `ns` on the wire is so. True if a character was through before: no more than one can be.
  bool level(int64_t ns, bool high, WireCharacter &character) {
    const bool through = until(ns, character);
    const bool idle = high == _idleHigh;
    if (!idle && _idle && _bit == Waiting) {
      _startNs = ns;
      _bit = 0;
      _bits = 0;
    }
    _idle = idle;
    return through;
  }

  // The wire stays as it is until `ns`.
  bool until(int64_t ns, WireCharacter &character);

  // In the middle of a character.
  bool busy() const { return _bit != Waiting; }

 private:
  static constexpr unsigned Waiting = 99;  // for an edge; else the number of the next bit, from the start bit's 0
  static constexpr unsigned StopBit = 10;

  const bool _idleHigh;
  const double _bitNs;
  const double _halfBitNs;
  bool _idle = false;  // what the capture begins with is no edge
  unsigned _bit = Waiting;
  unsigned _bits = 0;  // sampled so far, an idle one is 1
  int64_t _startNs = 0;
};

}  // namespace line
