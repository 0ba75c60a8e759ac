// Adds disturbances to another line, like those of a long wire beside a motor.
#pragma once

#include <memory>
#include <utility>

#include "line/Line.h"
#include "line/simulation/Random.h"

namespace line {

// Disturbances occur at random times, about `perSecond`. In a gap one is received as a random character, half of them
// with wrong parity; within a character it makes that character bad. About ten per second cost a frame now and then,
// about a hundred cost many, and with a thousand hardly any frame gets through.
class NoisyLine : public Line {
 public:
  NoisyLine(std::unique_ptr<Line> line, unsigned perSecond, uint32_t characterUs)
      : _line(std::move(line)), _longestUs(2000000 / perSecond), _characterUs(characterUs) {}

  void opened(uint64_t nowUs) override { _line->opened(nowUs); }
  bool next(uint64_t nowUs, Character &character) override {
    _hasQuiet = _hasQuiet || _line->next(nowUs + _characterUs, _quiet);
    const uint64_t noiseEndUs = _noiseUs + _characterUs;
    const bool noise =
        !_hasQuiet || noiseEndUs + _characterUs <= _quiet.endUs;  // there is room for a character of noise
    const uint64_t endUs = noise ? noiseEndUs : _quiet.endUs;
    if (endUs > nowUs) {
      return false;
    }
    if (noise) {
      character.value = _random.byte();
      character.bad = _random.chance(0.5);
    } else {
      character = _quiet;
      character.bad = character.bad || _noiseUs < endUs;
      _hasQuiet = false;
    }
    character.parityWrong = character.parityWrong || (character.bad && !character.stopWrong);
    character.endUs = endUs;
    while (_noiseUs < endUs) {
      _noiseUs += 1 + _random.below(_longestUs);
    }
    return true;
  }
  bool finished(uint64_t nowUs) const override { return _line->finished(nowUs); }
  void share(const LineSettings &tx) override { _line->share(tx); }
  void hear(const Character &character) override { _line->hear(character); }
  std::string report() const override { return _line->report(); }
  uint64_t knownUs(uint64_t nowUs) const override { return _line->knownUs(nowUs); }
  bool canAdvanceTo(uint64_t us) override { return _line->canAdvanceTo(us); }
  std::string failure() const override { return _line->failure(); }
  std::string news() override { return _line->news(); }

 private:
  std::unique_ptr<Line> _line;
  uint32_t _longestUs;  // the longest time between two disturbances; the average is half of that
  uint32_t _characterUs;
  Random _random{20181};  // a fixed seed, so that runs are repeatable
  Character _quiet;       // the next character of the other line, if any
  bool _hasQuiet = false;
  uint64_t _noiseUs = 0;  // the time of the next disturbance
};

}  // namespace line
