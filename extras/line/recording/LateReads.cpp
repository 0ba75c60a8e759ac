#include "line/recording/LateReads.h"

#include <utility>

#include "line/Silence.h"

namespace line {

namespace {

constexpr uint64_t StallMostUs = 4000000;  // system and browser hold 8 kB, which are 3 s of S.Bus
constexpr uint64_t MeasuredUs = 500000;
constexpr unsigned PartInaccurate = 16;  // of the pace

}  // namespace

void LateReads::put(const Character &character, std::deque<Character> &characters) {
  if (!_isHolding && _lastUs > 0 && character.endUs > _lastUs + SilenceUs) {
    finish(characters);
    _silentUs = character.endUs - _lastUs;
    _isHolding = mayBeLate(character);
  }
  _lastUs = character.endUs;
  if (!_isHolding) {
    measure(character);
    characters.push_back(character);
    return;
  }
  _held.push_back(character);
  const uint64_t sinceUs = character.endUs - _held.front().endUs + _silentUs;
  const bool isLate = accountsFor(sinceUs);
  if (isLate) {
    for (Character &each : _held) {
      each.lateUs = static_cast<uint32_t>(sinceUs);  // all are one read
    }
  }
  if (isLate || sinceUs > 2 * _silentUs) {
    finish(characters);
  }
}

void LateReads::finish(std::deque<Character> &characters) {
  characters.insert(characters.end(), _held.begin(), _held.end());
  _held.clear();
  _isHolding = false;
  _fromUs = 0;
}

// Exact times have no late reads, and reads that say that they are late need no proof.
bool LateReads::mayBeLate(const Character &character) const {
  return _paceUs > 0 && character.lateUs > 0 && character.lateUs < SilenceUs && _silentUs <= StallMostUs;
}

bool LateReads::accountsFor(uint64_t us) const {
  return _held.size() * _paceUs / _paceCount + us / PartInaccurate >= us;
}

// Measures the pace over half a second without a silence or a late read.
void LateReads::measure(const Character &character) {
  if (_fromUs == 0 || character.lateUs >= SilenceUs) {
    _fromUs = character.endUs;
    _count = 0;
  } else if (++_count; character.endUs >= _fromUs + MeasuredUs) {
    _paceUs = character.endUs - std::exchange(_fromUs, character.endUs);
    _paceCount = std::exchange(_count, 0);
  }
}

}  // namespace line
