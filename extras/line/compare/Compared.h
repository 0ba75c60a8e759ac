// One of the two lines being compared: passes its frames to the Comparison.
#pragma once

#include <cstddef>
#include <cstdint>

#include "line/Observer.h"
#include "line/compare/Comparison.h"

namespace line {

class Compared {
 public:
  // `side`: 0 or 1.
  Compared(size_t side, uint32_t characterUs, Comparison &comparison) : _side(side), _comparison(comparison) {
    _observer.reset(0, characterUs);
    _observer.listen([this](const Stretch &stretch) {
      if (stretch.isFrame() && stretch.kind != Stretch::Kind::Extra) {
        _comparison.put(_side, timeOf(stretch.endUs()), _observer.newest(), stretch.lateUs());
      }
    });
  }
  Compared(const Compared &) = delete;
  Compared &operator=(const Compared &) = delete;

  // Sets the offset to add to its times. Its frames begin at time 0 or later.
  void begin(int64_t laterUs) {
    _laterUs = laterUs;
    _comparison.knownUntil(_side, timeOf(0));
  }

  void put(const Character &character) {
    _comparison.heard(_side, timeOf(character.endUs));
    _observer.put(character);
  }

  // Takes the time up to which it is known. `isOver`: the line has ended before.
  void knownUntil(uint64_t us, bool isOver) {
    if (!isOver && _observer.characters() > 0) {
      _comparison.heard(_side, timeOf(us));
    }
    _comparison.knownUntil(_side, timeOf(us) - HeldUs);
  }

  Observer &observer() { return _observer; }

 private:
  static constexpr int64_t HeldUs = 100000;  // a frame may wait for the next bytes

  int64_t timeOf(uint64_t us) const { return static_cast<int64_t>(us) + _laterUs; }

  const size_t _side;
  Comparison &_comparison;
  Observer _observer;
  int64_t _laterUs = 0;
};

}  // namespace line
