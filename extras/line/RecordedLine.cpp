#include "RecordedLine.h"

namespace line {

bool RecordedLine::next(uint64_t nowUs, Character &character) {
  if (_index == _recording.characters.size() || _zeroUs + _recording.characters[_index].endUs > nowUs) {
    return false;
  }
  character = _recording.characters[_index++];
  character.endUs += _zeroUs;
  return true;
}

bool RecordedLine::finished(uint64_t nowUs) const {
  return nowUs >= _zeroUs + _recording.characters.back().endUs + TailUs;
}

}  // namespace line
