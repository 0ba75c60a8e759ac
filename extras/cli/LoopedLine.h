// Plays a line repeatedly.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "line/Line.h"

namespace tool {

class LoopedLine : public line::Line {
 public:
  // `open` returns the line, from `fromUs` of its own time on.
  LoopedLine(std::function<std::unique_ptr<line::Line>()> open, uint64_t fromUs)
      : _open(std::move(open)), _line(_open()), _fromUs(fromUs) {}

  bool next(uint64_t nowUs, line::Character &character) override {
    if (_line->finished(nowUs - _shiftUs)) {
      _line = _open();
      _shiftUs = nowUs - _fromUs;
    }
    const bool came = _line->next(nowUs - _shiftUs, character);
    character.endUs += came ? _shiftUs : 0;
    return came;
  }
  uint64_t knownUs(uint64_t nowUs) const override { return _shiftUs + _line->knownUs(nowUs - _shiftUs); }
  std::string failure() const override { return _line->failure(); }
  std::string news() override { return _line->news(); }

 private:
  const std::function<std::unique_ptr<line::Line>()> _open;
  std::unique_ptr<line::Line> _line;
  const uint64_t _fromUs;
  uint64_t _shiftUs = 0;  // from the line's time to the program's
};

}  // namespace tool
