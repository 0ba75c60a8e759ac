#include "SimulatedLine.h"

#include "line/simulation/NoisyLine.h"

namespace scope {

SimulatedLine::SimulatedLine(line::Sticks sticks, line::Channels channels, unsigned noise,
                             const line::LineSettings &settings)
    : _settings(settings),
      _line(std::make_unique<line::SimulatedReceiver>(line::choreography(sticks), settings.characterUs(), channels)) {
  if (noise > 0) {
    _line = std::make_unique<line::NoisyLine>(std::move(_line), noise, settings.characterUs());
  }
  setPort(0, settings);
}

bool SimulatedLine::next(uint64_t nowUs, line::Character &character) {
  while (!_sampler.next(_knownUs, character)) {
    line::Character sent;
    if (!_line->next(nowUs, sent)) {
      _knownUs = nowUs;
      return _sampler.next(nowUs, character);
    }
    _knownUs = sent.endUs;
    if (!_cut) {
      _sampler.put(sent);
    }
  }
  return true;
}

}  // namespace scope
