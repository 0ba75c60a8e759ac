#include "line/recording/RecordedLine.h"

namespace line {

bool RecordedLine::next(uint64_t nowUs, Character &character) {
  if (_index == _characters->size() || _zeroUs + (*_characters)[_index].endUs > nowUs) {
    return false;
  }
  character = (*_characters)[_index++];
  character.endUs += _zeroUs;
  return true;
}

uint64_t RecordedLine::knownUs(uint64_t nowUs) const {
  return nowUs < _zeroUs ? 0 : _zeroUs + _characters->knownUs(_index, nowUs - _zeroUs);
}

bool RecordedLine::finished(uint64_t nowUs) const {
  return nowUs >= _zeroUs + _characters->back().endUs + TailUs;
}

}  // namespace line
