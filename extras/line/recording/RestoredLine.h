// Restores the line of a late port, or a recording from one, for a sketch, which polls a UART: frames of back-to-back
// characters, with gaps between frames, however the port delivered them.
#pragma once

#include <algorithm>
#include <deque>
#include <memory>
#include <string>
#include <utility>

#include "line/Line.h"
#include "line/Observer.h"

namespace line {

class RestoredLine : public Line {
 public:
  RestoredLine(std::unique_ptr<Line> line, uint32_t characterUs) : _line(std::move(line)), _characterUs(characterUs) {
    _observer.reset(0, characterUs);
    _observer.listen([this](const Stretch &stretch) { take(stretch); });
  }

  void opened(uint64_t nowUs) override { _line->opened(nowUs); }
  bool next(uint64_t nowUs, Character &character) override {
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
  bool finished(uint64_t nowUs) const override { return _line->finished(nowUs) && _waiting.empty(); }
  std::string failure() const override { return _line->failure(); }
  std::string news() override { return _line->news(); }

 private:
  static constexpr uint64_t PollUs = 200;       // polling the port more often is useless
  static constexpr uint64_t GapCharacters = 5;  // short enough for a frame every 4 ms

  void take(const Stretch &stretch) {
    _lastEndUs = std::max(_nowUs, _lastEndUs + GapCharacters * _characterUs);
    for (const Character &brought : stretch.characters) {
      _lastEndUs += _characterUs;
      _waiting.push_back({_lastEndUs, brought.value, brought.bad});
    }
  }

  std::unique_ptr<Line> _line;
  const uint32_t _characterUs;
  Observer _observer;
  std::deque<Character> _waiting;
  uint64_t _nowUs = 0;
  uint64_t _lastEndUs = 0;
  uint64_t _nextPollUs = 0;
};

}  // namespace line
