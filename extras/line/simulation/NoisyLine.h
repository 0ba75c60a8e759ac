// Adds disturbances to another line, like those of a long wire beside a motor.
#pragma once

#include <memory>
#include <utility>

#include "line/Line.h"
#include "line/simulation/Random.h"

namespace line {

// Disturbances come at random times, about `perSecond` of them. One that falls into a gap is seen as a character of
// any value, half of them with a wrong parity; one that falls into a character makes that character bad. So some ten a
// second cost a frame now and then, some hundred a good part of them, and with a thousand hardly any gets through.
class NoisyLine : public Line {
 public:
  NoisyLine(std::unique_ptr<Line> line, unsigned perSecond, uint32_t characterUs)
      : _line(std::move(line)), _longestUs(2000000 / perSecond), _characterUs(characterUs) {}

  void opened(uint64_t nowUs) override { _line->opened(nowUs); }
  bool next(uint64_t nowUs, Character &character) override;
  bool finished(uint64_t nowUs) const override { return _line->finished(nowUs); }
  void share(const LineSettings &tx) override { _line->share(tx); }
  void hear(const Character &character) override { _line->hear(character); }
  std::string report() const override { return _line->report(); }
  uint64_t knownUs(uint64_t nowUs) const override { return _line->knownUs(nowUs); }
  bool mayGoTo(uint64_t us) override { return _line->mayGoTo(us); }
  std::string failure() const override { return _line->failure(); }

 private:
  std::unique_ptr<Line> _line;
  uint32_t _longestUs;  // the longest time between two disturbances; the average is half
  uint32_t _characterUs;
  Random _random{20181};  // any seed, but always the same one, so that runs are repeatable
  Character _quiet;       // the next character of the other line, if there is one
  bool _hasQuiet = false;
  uint64_t _noiseUs = 0;  // when the next disturbance comes
};

}  // namespace line
