// A port's line for a sketch, which polls a UART: each frame back to back, and gaps between them, however the port has
// brought them.
#pragma once

#include <deque>
#include <memory>
#include <string>
#include <utility>

#include "line/Line.h"
#include "line/Observer.h"

namespace line {

class RestoredLine : public Line {
 public:
  explicit RestoredLine(std::unique_ptr<Line> line) : _line(std::move(line)) {
    _observer.listen([this](const Stretch &stretch) { take(stretch); });
  }

  bool next(uint64_t nowUs, Character &character) override;
  std::string failure() const override { return _line->failure(); }

 private:
  static constexpr uint64_t PollUs = 200;               // asking the port more often finds nothing
  static constexpr uint64_t GapUs = 5 * CharacterUs;    // so that even a frame each 4 ms has time

  void take(const Stretch &stretch);

  std::unique_ptr<Line> _line;
  Observer _observer;
  std::deque<Character> _waiting;
  uint64_t _nowUs = 0;
  uint64_t _lastEndUs = 0;
  uint64_t _nextPollUs = 0;
};

}  // namespace line
