#include "cli/LoopedLine.h"

#include <algorithm>
#include <utility>

namespace tool {

namespace {

constexpr uint64_t AheadUs = 2 * line::TailUs;  // the end is known before the last frame is due
constexpr size_t EndsMost = 100;

}  // namespace

bool LoopedLine::next(uint64_t nowUs, line::Character &character) {
  fill(nowUs);
  if (_waiting.empty() || _waiting.front().endUs > nowUs) {
    return false;
  }
  character = _waiting.front();
  _waiting.pop_front();
  return true;
}

uint64_t LoopedLine::knownUs(uint64_t nowUs) const {
  if (_waiting.empty()) {
    return nowUs;
  }
  const line::Character &next = _waiting.front();
  return std::min(nowUs, next.endUs - std::min<uint64_t>(next.endUs, _characterUs + next.lateUs));
}

void LoopedLine::beginPass() {
  _line = _open();
  _line->opened(0);
  _observer.emplace();
  _observer->reset(_fromUs, _characterUs);
  _observer->listen([this](const line::Stretch &stretch) { take(stretch); });
  _readUs = _fromUs;
  _shiftUs.reset();
  _between.clear();
}

// Reads ahead of the time. The first pass keeps its times; a later one is read at once up to its first frame.
void LoopedLine::fill(uint64_t nowUs) {
  constexpr uint64_t StepUs = 30000;
  const auto isEnough = [&] {
    const int64_t shiftUs = _shiftUs.value_or(0);
    return (_shiftUs || !_dueUs) && static_cast<int64_t>(_readUs) + shiftUs >= static_cast<int64_t>(nowUs + AheadUs);
  };
  while (_failure.empty() && _line->failure().empty() && !isEnough()) {
    _readUs += StepUs;
    for (line::Character character; _line->next(_readUs, character);) {
      if (_hasFrames) {
        _observer->put(character);
      } else {
        take({line::Stretch::Kind::Frame, 0, {character}, {}, {}});
      }
    }
    _observer->idleUntil(_line->knownUs(_readUs));
    if (_line->finished(_readUs)) {
      endPass();
    }
  }
}

void LoopedLine::endPass() {
  _observer->finish();
  if (!_shiftUs) {
    _failure = "--loop: there is no whole frame to repeat";
    return;
  }
  _dueUs = _endsUs.back() + periodUs();
  beginPass();
}

// Returns the usual time from one frame to the next.
uint64_t LoopedLine::periodUs() const {
  constexpr uint64_t OneFrameUs = 9000;  // the paper's receiver
  std::vector<uint64_t> periods;
  for (size_t i = 1; i < _endsUs.size(); i++) {
    periods.push_back(_endsUs[i] - _endsUs[i - 1]);
  }
  if (periods.empty()) {
    return OneFrameUs;
  }
  const auto middle = periods.begin() + static_cast<std::ptrdiff_t>(periods.size() / 2);
  std::nth_element(periods.begin(), middle, periods.end());
  return *middle;
}

// What lies between frames is played with the frame after it.
void LoopedLine::take(const line::Stretch &stretch) {
  if (!stretch.isFrame()) {
    if (_shiftUs) {
      _between.insert(_between.end(), stretch.characters.begin(), stretch.characters.end());
    }
    return;
  }
  if (!_shiftUs) {
    _shiftUs = static_cast<int64_t>(_dueUs.value_or(stretch.endUs())) - static_cast<int64_t>(stretch.endUs());
    _first = stretch.kind;
    _endsUs.clear();
  }
  play(std::exchange(_between, {}));
  play(stretch.characters);
  if (stretch.kind == _first) {
    _endsUs.push_back(_waiting.back().endUs);
    _endsUs.erase(_endsUs.begin(), _endsUs.end() - static_cast<std::ptrdiff_t>(std::min(_endsUs.size(), EndsMost)));
  }
}

void LoopedLine::play(const std::vector<line::Character> &characters) {
  for (line::Character character : characters) {
    const uint64_t endUs = static_cast<uint64_t>(static_cast<int64_t>(character.endUs) + *_shiftUs);
    character.endUs = _waiting.empty() ? endUs : std::max(endUs, _waiting.back().endUs + 1);
    _waiting.push_back(character);
  }
}

}  // namespace tool
