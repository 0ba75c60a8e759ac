// Recognises what is wrong with a sender from the errors of its characters, 8E2 or 8E1: many adapters drop these, a
// capture keeps them.
#pragma once

#include <algorithm>
#include <cstdint>

#include "line/Line.h"
#include "sbus/Diagnosis.h"

namespace line {

class SenderFaults {
 public:
  // Takes the next character.
  void put(const Character &character) {
    constexpr uint64_t QuietUs = 2000;
    if (_breakUs > 0 && character.endUs - std::min(character.endUs, _breakUs) > QuietUs) {
      _breaks++;
    }
    const bool isBreak = character.bad && character.value == 0 && !character.parityWrong;
    _breakUs = isBreak && _good >= GoodLeast ? character.endUs : 0;
    _good = character.bad ? 0 : _good + 1;

    // Without a parity bit, the stop bit is taken for it: the characters with an even number of ones are wrong.
    const bool isEven = !isOdd(character.value);
    const bool isSo = isEven == character.bad && !character.stopWrong;
    _even = isSo ? _even + isEven : 0;
    _odd = isSo ? _odd + !isEven : 0;
    _bits = static_cast<uint8_t>(_bits | character.value);
    _characters++;
  }

  // Returns NoParity, IdleLevel or SevenBits; NoSignal if it is neither of them, or not known yet.
  sbus::Finding found() const {
    return _even >= ParityLeast && _odd >= ParityLeast  ? sbus::Finding::NoParity
           : _breaks >= BreaksLeast                     ? sbus::Finding::IdleLevel
           : _characters >= SevenLeast && _bits == 0x7F ? sbus::Finding::SevenBits
                                                        : sbus::Finding::NoSignal;
  }

 private:
  static constexpr unsigned ParityLeast = 20;  // characters one after the other: of random ones, one in 2^40
  static constexpr unsigned GoodLeast = 12;    // before a break: with the wrong polarity there are hardly any
  static constexpr unsigned BreaksLeast = 4;
  static constexpr uint64_t SevenLeast = 1000;  // characters: 40 frames

  uint8_t _bits = 0;  // all that were set
  uint64_t _characters = 0;
  unsigned _even = 0;
  unsigned _odd = 0;
  unsigned _good = 0;     // characters since the newest wrong one
  unsigned _breaks = 0;   // that follow good characters, and after which the line is silent
  uint64_t _breakUs = 0;  // the newest character's end, if it is such a break
};

}  // namespace line
