#include "line/uart/UartSampler.h"

#include <algorithm>

namespace line {

namespace {

constexpr int64_t NsPerUs = 1000;

}  // namespace

void UartSampler::open(uint64_t nowUs, const LineSettings &port, const LineSettings &line) {
  _port = port;
  _line = line;
  _line.polarity = line.polarity == Polarity::Either ? port.polarity : line.polarity;
  _decoder = CharacterDecoder(port, port.bitNs());
  _decoder.level(static_cast<int64_t>(nowUs) * NsPerUs, _line.idleHigh(), _newest);
  _seen.clear();
  _knownUs = nowUs;
}

void UartSampler::put(const Character &character) {
  if (character.endUs < _knownUs + _line.characterUs()) {
    return;
  }
  encode(character, _line, [this](int64_t ns, bool high) { take(_decoder.level(ns, high, _newest)); });
  _knownUs = character.endUs;
}

bool UartSampler::next(uint64_t nowUs, Character &character) {
  // A character in transit has not been put yet: the time in which it may have begun is not known.
  const uint64_t knownUs = std::max(_knownUs, nowUs - std::min<uint64_t>(nowUs, _line.characterUs()));
  take(_decoder.until(static_cast<int64_t>(knownUs) * NsPerUs, _newest));
  if (_seen.empty() || _seen.front().endUs > knownUs) {
    return false;
  }
  character = _seen.front();
  _seen.pop_front();
  return true;
}

void UartSampler::take(bool through) {
  if (through) {
    const int64_t endNs = _newest.startNs + static_cast<int64_t>(_port.characterNs());
    _seen.push_back({static_cast<uint64_t>((endNs + NsPerUs - 1) / NsPerUs), _newest.value, _newest.bad(), 0,
                     _newest.parityWrong, _newest.stopWrong});
  }
}

}  // namespace line
