#include "line/simulation/NoisyLine.h"

namespace line {

bool NoisyLine::next(uint64_t nowUs, Character &character) {
  _hasQuiet = _hasQuiet || _line->next(nowUs + _characterUs, _quiet);
  const uint64_t noiseEndUs = _noiseUs + _characterUs;
  const bool noise = !_hasQuiet || noiseEndUs + _characterUs <= _quiet.endUs;  // there is room for a character of noise
  const uint64_t endUs = noise ? noiseEndUs : _quiet.endUs;
  if (endUs > nowUs) {
    return false;
  }
  if (noise) {
    character.value = _random.byte();
    character.bad = _random.chance(0.5);
  } else {
    character = _quiet;
    character.bad = character.bad || _noiseUs < endUs;
    _hasQuiet = false;
  }
  character.parityWrong = character.parityWrong || (character.bad && !character.stopWrong);
  character.endUs = endUs;
  while (_noiseUs < endUs) {
    _noiseUs += 1 + _random.below(_longestUs);
  }
  return true;
}

}  // namespace line
