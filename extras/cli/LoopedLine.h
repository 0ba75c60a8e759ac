// Plays a file repeatedly.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "line/Line.h"
#include "line/Observer.h"

namespace tool {

// Each pass follows the one before it at the period of the line's frames, and begins and ends with a whole frame.
class LoopedLine : public line::Line {
 public:
  // `open` returns the line, from `fromUs` of its own time on. Without `hasFrames` each character is repeated.
  LoopedLine(std::function<std::unique_ptr<line::Line>()> open, uint64_t fromUs, uint32_t characterUs, bool hasFrames)
      : _open(std::move(open)), _fromUs(fromUs), _characterUs(characterUs), _hasFrames(hasFrames) {
    beginPass();
  }

  bool next(uint64_t nowUs, line::Character &character) override {
    fill(nowUs);
    if (_waiting.empty() || _waiting.front().endUs > nowUs) {
      return false;
    }
    character = _waiting.front();
    _waiting.pop_front();
    return true;
  }

  uint64_t knownUs(uint64_t nowUs) const override {
    if (_waiting.empty()) {
      return nowUs;
    }
    const line::Character &next = _waiting.front();
    return std::min(nowUs, next.endUs - std::min<uint64_t>(next.endUs, _characterUs + next.lateUs));
  }

  std::string failure() const override { return _line->failure().empty() ? _failure : _line->failure(); }
  std::string news() override { return _line->news(); }

 private:
  static constexpr uint64_t AheadUs = 2 * line::TailUs;  // the end is known before the last frame is due
  static constexpr size_t EndsMost = 100;

  void beginPass() {
    _line = _open();
    _line->opened(0);
    _observer.emplace();
    _observer->reset(_fromUs, _characterUs);
    _observer->listen([this](const line::Stretch &stretch) { take(stretch); });
    _readUs = _fromUs;
    _shiftUs.reset();
    _between.clear();
  }

  void endPass() {
    _observer->finish();
    if (!_shiftUs) {
      _failure = "--loop: there is no whole frame to repeat";
      return;
    }
    _dueUs = _endsUs.back() + periodUs();
    beginPass();
  }

  // Reads ahead of the time. The first pass keeps its times; a later one is read at once up to its first frame.
  void fill(uint64_t nowUs) {
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

  // What lies between frames is played with the frame after it.
  void take(const line::Stretch &stretch) {
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

  void play(const std::vector<line::Character> &characters) {
    for (line::Character character : characters) {
      const uint64_t endUs = static_cast<uint64_t>(static_cast<int64_t>(character.endUs) + *_shiftUs);
      character.endUs = _waiting.empty() ? endUs : std::max(endUs, _waiting.back().endUs + 1);
      _waiting.push_back(character);
    }
  }

  // Returns the usual time from one frame to the next.
  uint64_t periodUs() const {
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

  const std::function<std::unique_ptr<line::Line>()> _open;
  const uint64_t _fromUs;
  const uint32_t _characterUs;
  const bool _hasFrames;
  std::unique_ptr<line::Line> _line;
  std::optional<line::Observer> _observer;
  uint64_t _readUs = 0;                   // the pass has been read up to this time of its own
  std::optional<int64_t> _shiftUs;        // from its time to the program's; none before its first frame
  std::optional<uint64_t> _dueUs;         // when its first frame ends; none in the first pass
  line::Stretch::Kind _first{};           // the kind of its first frame
  std::vector<uint64_t> _endsUs;          // the ends of its newest frames of this kind, in the program's time
  std::vector<line::Character> _between;  // what has come since the last frame
  std::deque<line::Character> _waiting;
  std::string _failure;
};

}  // namespace tool
