// A recording that is handed over part by part, so that a decoder's memory stays small, and can be kept and restored.
#pragma once

#include <algorithm>
#include <cstddef>

#include "line/Line.h"

namespace scope {

class FedLine : public line::Line {
 public:
  static constexpr size_t PartMax = 256;  // characters

  // Takes the next characters, PartMax at most. Call it only when needsMore() is true.
  void feed(const line::Character *characters, size_t count, bool areLast) {
    std::copy_n(characters, count, _part);
    _at = 0;
    _count = count;
    _areLast = areLast;
  }

  // Returns true if it needs the next part.
  bool needsMore() const { return _at == _count && !_areLast; }

  bool next(uint64_t nowUs, line::Character &character) override {
    if (_at == _count || _part[_at].endUs > nowUs) {
      return false;
    }
    character = _part[_at++];
    return true;
  }

  uint64_t knownUs(uint64_t nowUs) const override {
    if (_at == _count) {
      return nowUs;
    }
    const line::Character &next = _part[_at];
    return std::min(nowUs, next.endUs - std::min<uint64_t>(next.endUs, line::CharacterUs + next.lateUs));
  }

  bool atEnd() const { return _at == _count && _areLast; }

 private:
  line::Character _part[PartMax];
  size_t _at = 0;
  size_t _count = 0;
  bool _areLast = false;
};

}  // namespace scope
