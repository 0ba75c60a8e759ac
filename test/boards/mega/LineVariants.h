// Lines with something wrong with them.
#pragma once

#include <memory>
#include <utility>

#include "line/Line.h"

namespace mega {

// Another line, of which one character has a wrong parity bit.
class OneBadCharacter : public line::Line {
 public:
  // `number` of the character, counted from 0 at the line's beginning.
  OneBadCharacter(std::unique_ptr<line::Line> line, unsigned long number) : _line(std::move(line)), _left(number) {}

  void opened(uint64_t nowUs) override { _line->opened(nowUs); }
  bool finished(uint64_t nowUs) const override { return _line->finished(nowUs); }

  bool next(uint64_t nowUs, line::Character &character) override {
    if (!_line->next(nowUs, character)) {
      return false;
    }
    character.bad = character.bad || _left == 0;
    _left--;  // wraps after it, and 2^32 characters are 143 hours
    return true;
  }

 private:
  std::unique_ptr<line::Line> _line;
  unsigned long _left;
};

// Another line, cut at a certain time. A character that was not through by then does not come.
class CutLine : public line::Line {
 public:
  CutLine(std::unique_ptr<line::Line> line, uint64_t cutUs) : _line(std::move(line)), _cutUs(cutUs) {}

  void opened(uint64_t nowUs) override { _line->opened(nowUs); }
  bool finished(uint64_t nowUs) const override { return _line->finished(nowUs); }

  bool next(uint64_t nowUs, line::Character &character) override {
    return _line->next(nowUs < _cutUs ? nowUs : _cutUs, character);
  }

 private:
  std::unique_ptr<line::Line> _line;
  uint64_t _cutUs;
};

}  // namespace mega
