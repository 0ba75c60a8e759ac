#include "CharacterDecoder.h"

namespace line {

bool CharacterDecoder::until(int64_t ns, WireCharacter &character) {
  if (_bit == Waiting) {
    return false;
  }
  const double reached = static_cast<double>(ns - _startNs);
  for (; _bit * _bitNs + _halfBitNs < reached; _bit++) {
    if (_bit == 0 && _idle) {
      _bit = Waiting;
      return false;
    }
    if (_bit == StopBit) {
      character.startNs = _startNs;
      character.value = static_cast<uint8_t>(_bits >> 1);
      character.parityWrong = isOdd(_bits);
      character.stopWrong = !_idle;
      _bit = Waiting;
      return true;
    }
    _bits |= static_cast<unsigned>(_idle) << _bit;
  }
  return false;
}

}  // namespace line
