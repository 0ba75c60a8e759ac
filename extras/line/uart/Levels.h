// Converts characters to a wire's levels, and levels to characters, like a UART.
#pragma once

#include <cmath>
#include <cstdint>

#include "line/Line.h"
#include "line/LineSettings.h"

namespace line {

// Calls level(ns, high) with the wire's level at the beginning of each of the character's bits. A character with an
// error gets a wrong parity bit, if the format has one.
template <typename OnLevel>
void encode(const Character &character, const LineSettings &line, OnLevel level) {
  const Format &format = line.format;
  const unsigned data = character.value & ((1u << format.dataBits) - 1);
  const bool even = isOdd(data) != character.bad;  // the bit that makes the number of ones even
  const bool parity = even != (format.parity == Parity::Odd);
  const unsigned stop = ~0u << (format.dataBits + format.parityBits());
  const unsigned bits = (stop | static_cast<unsigned>(parity) << format.dataBits | data) << 1;  // idle is 1
  int64_t ns = (static_cast<int64_t>(character.endUs) - line.characterUs()) * 1000;
  for (unsigned i = 0; i < format.bits(); i++, ns += line.bitNs()) {
    level(ns, ((bits >> i & 1) != 0) == line.idleHigh());
  }
}

// A character as it was on a wire.
struct WireCharacter {
  int64_t startNs = 0;  // where its start bit begins
  uint8_t value = 0;
  bool parityWrong = false;
  bool stopWrong = false;  // a framing error: the first stop bit is not idle

  bool bad() const { return parityWrong || stopWrong; }

  // Returns the character for an Observer, with its time since `zeroNs`. `characterNs`: its length.
  Character since(int64_t zeroNs, double characterNs) const {
    const double endNs = static_cast<double>(startNs - zeroNs) + characterNs;
    return {static_cast<uint64_t>(endNs / 1000), value, bad(), 0, parityWrong, stopWrong};
  }
};

// Decodes levels like most UARTs: an edge from idle to active begins a character, unless the line is idle again in the
// middle of the start bit. Each bit is sampled in its middle; the first stop bit ends the character.
class CharacterDecoder {
 public:
  // `bitNs`: as measured.
  CharacterDecoder(const LineSettings &settings, double bitNs)
      : _idleHigh(settings.idleHigh()),
        _format(settings.format),
        _stopBit(_format.bits() - _format.stopBits),
        _bitNs(std::llround(bitNs)) {}

  // Takes the wire's level from `ns` on; the first level is not an edge. Returns true if a character was complete
  // before that; there is at most one.
  bool level(int64_t ns, bool high, WireCharacter &character) {
    bool through = until(ns, character);
    const bool wasIdle = _idle;
    _idle = high == _idleHigh;
    if (_sampleNs == ns) {  // a sample exactly at the edge has the new level
      through = until(ns + 1, character);
    }
    if (wasIdle && !_idle && _sampleNs == Never) {
      _startNs = ns;
      _sampleNs = ns + _bitNs / 2;
      _bit = 0;
      _bits = 0;
    }
    return through;
  }

  // Takes the time up to which the wire keeps its level. Returns true if a character was complete before that.
  bool until(int64_t ns, WireCharacter &character) {
    for (; _sampleNs < ns; _sampleNs += _bitNs, _bit++) {
      if (_bit == 0 && _idle) {
        _sampleNs = Never;
        return false;
      }
      if (_bit == _stopBit) {
        const unsigned bits = _bits >> 1;
        character.startNs = _startNs;
        character.value = static_cast<uint8_t>(bits & ((1u << _format.dataBits) - 1));
        character.parityWrong = _format.parity != Parity::None && isOdd(bits) != (_format.parity == Parity::Odd);
        character.stopWrong = !_idle;
        _sampleNs = Never;
        return true;
      }
      _bits |= static_cast<unsigned>(_idle) << _bit;
    }
    return false;
  }

 private:
  static constexpr int64_t Never = INT64_MAX;

  bool _idleHigh;
  Format _format;
  unsigned _stopBit;  // the number of the first one; the start bit is 0
  int64_t _bitNs;
  bool _idle = false;
  int64_t _startNs = 0;
  int64_t _sampleNs = Never;  // the middle of the next bit; Never while an edge is awaited
  unsigned _bit = 0;          // its number
  unsigned _bits = 0;         // sampled so far; idle is 1
};

}  // namespace line
