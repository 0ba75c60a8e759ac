#include "line/uart/Levels.h"

#include <cmath>

namespace line {

CharacterDecoder::CharacterDecoder(const LineSettings &settings, double bitNs)
    : _idleHigh(settings.idleHigh()),
      _format(settings.format),
      _stopBit(_format.bits() - _format.stopBits),
      _bitNs(std::llround(bitNs)) {
}

bool CharacterDecoder::until(int64_t ns, WireCharacter &character) {
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

}  // namespace line
