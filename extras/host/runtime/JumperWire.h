// A wire from the TX pin of one of the board's ports to the RX pin of one of them.
#pragma once

#include <deque>

#include "Line.h"

namespace host {

class JumperWire : public Line {
 public:
  // A character has been sent.
  void put(const Character &character) { _characters.push_back(character); }

  bool next(uint64_t nowUs, Character &character) override {
    if (_characters.empty() || _characters.front().endUs > nowUs) {
      return false;
    }
    character = _characters.front();
    _characters.pop_front();
    return true;
  }

 private:
  std::deque<Character> _characters;
};

}  // namespace host
