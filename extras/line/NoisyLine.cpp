#include "NoisyLine.h"

namespace line {

void NoisyLine::opened(uint64_t nowUs) {
  _line->opened(nowUs);
  _open = true;
  _freeUs = nowUs;
  takeQuiet();
  takeNoise(nowUs);
}

bool NoisyLine::next(uint64_t nowUs, Character &character) {
  while (_open && !quietIsNext()) {
    if (_noiseUs + _characterUs > nowUs) {
      return false;
    }
    const bool free = _noiseUs >= _freeUs;  // else it falls into a disturbance, and makes nothing worse
    character.endUs = _noiseUs + _characterUs;
    character.value = static_cast<uint8_t>(_random() >> 8);
    character.bad = (_random() >> 8) % 2 != 0;
    takeNoise(_noiseUs);
    if (free) {
      _freeUs = character.endUs;
      return true;
    }
  }
  if (!_open || _quiet.endUs > nowUs) {
    return false;
  }
  character = _quiet;
  for (; _noiseUs < _quiet.endUs; takeNoise(_noiseUs)) {
    character.bad = true;
  }
  _freeUs = _quiet.endUs;
  takeQuiet();
  return true;
}

// True if the next disturbance leaves no room for a character of its own before the next one of the other line.
bool NoisyLine::quietIsNext() const {
  return _hasQuiet && _noiseUs + _characterUs > _quiet.endUs - _characterUs;
}

void NoisyLine::takeQuiet() {
  _hasQuiet = _line->next(UINT64_MAX, _quiet);
}

void NoisyLine::takeNoise(uint64_t afterUs) {
  _noiseUs = afterUs + 1 + _random() % _longestUs;
}

}  // namespace line
