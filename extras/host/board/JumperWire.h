// A wire from the TX pin of one of the board's ports to the RX pin of the same or another port.
#pragma once

#include <deque>

#include "line/Line.h"

namespace host {

class JumperWire : public line::Line {
 public:
  // Takes a sent character.
  void put(const line::Character &character) { _characters.push_back(character); }

  bool next(uint64_t nowUs, line::Character &character) override {
    if (_characters.empty() || _characters.front().endUs > nowUs) {
      return false;
    }
    character = _characters.front();
    _characters.pop_front();
    return true;
  }

 private:
  std::deque<line::Character> _characters;
};

}  // namespace host
