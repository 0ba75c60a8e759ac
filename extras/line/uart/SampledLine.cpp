#include "line/uart/SampledLine.h"

namespace line {

void SampledLine::opened(uint64_t nowUs) {
  _line->opened(nowUs);
  _sampler.open(nowUs, _port, _settings);
}

bool SampledLine::next(uint64_t nowUs, Character &character) {
  if (_agrees) {
    return _line->next(nowUs, character);
  }
  for (Character sent; _line->next(nowUs, sent);) {
    _sampler.put(sent);
  }
  return _sampler.next(nowUs, character);
}

}  // namespace line
