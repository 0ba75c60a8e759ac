#include "line/recording/RestoredLine.h"

#include <algorithm>

namespace line {

bool RestoredLine::next(uint64_t nowUs, Character &character) {
  if (nowUs >= _nextPollUs) {
    _nextPollUs = nowUs + PollUs;
    _nowUs = nowUs;
    for (Character brought; _line->next(nowUs, brought);) {
      _observer.put(brought);
    }
    _observer.idleUntil(_line->knownUs(nowUs));
  }
  if (_waiting.empty() || _waiting.front().endUs > nowUs) {
    return false;
  }
  character = _waiting.front();
  _waiting.pop_front();
  return true;
}

void RestoredLine::take(const Stretch &stretch) {
  _lastEndUs = std::max(_nowUs, _lastEndUs + GapCharacters * _characterUs);
  for (const Character &brought : stretch.characters) {
    _lastEndUs += _characterUs;
    _waiting.push_back({_lastEndUs, brought.value, brought.bad});
  }
}

}  // namespace line
