#include "UartSampler.h"

#include <algorithm>

namespace line {

namespace {

constexpr uint64_t NsPerUs = 1000;

unsigned dataOf(unsigned bits, const Format &format) {
  return bits & ((1u << format.dataBits) - 1);
}

}  // namespace

void UartSampler::open(uint64_t nowUs, const LineSettings &port, const LineSettings &line) {
  _line = line;
  _bitNs = port.bitNs();
  _format = port.format;
  _flipped = !samePolarity(port, line);
  _edges.clear();
  _idle = !_flipped;
  _fromNs = nowUs * NsPerUs;
  _knownNs = _fromNs;
}

void UartSampler::put(const Character &character) {
  uint64_t ns = (character.endUs - _line.characterUs()) * NsPerUs;
  if (ns < _knownNs) {
    return;
  }
  const auto bit = [&](bool high) {
    level(ns, high);
    ns += _line.bitNs();
  };
  bit(false);
  const Format &format = _line.format;
  for (unsigned i = 0; i < format.dataBits; i++) {
    bit((character.value >> i & 1) != 0);
  }
  if (format.parity != Parity::None) {
    const bool even = isOdd(dataOf(character.value, format));  // what makes the number of ones even
    bit((even != (format.parity == Parity::Odd)) != character.bad);
  }
  bit(true);
  _knownNs = character.endUs * NsPerUs;
}

bool UartSampler::next(uint64_t nowUs, Character &character) {
  // A character that is on its way has not been put, so nothing is known of the time in which it may have begun.
  const uint64_t characterNs = _line.characterUs() * NsPerUs;
  const uint64_t knownNs = std::max(_knownNs, nowUs * NsPerUs - std::min(nowUs * NsPerUs, characterNs));
  while (true) {
    while (!_edges.empty() && (_edges.front().idle || _edges.front().ns < _fromNs)) {
      _edges.pop_front();
    }
    if (_edges.empty()) {
      return false;
    }
    const uint64_t startNs = _edges.front().ns;
    const unsigned stopBit = _format.bits() - _format.stopBits;  // the first, counted from the start bit
    const uint64_t endNs = startNs + uint64_t{_format.bits()} * _bitNs;
    if (endNs > knownNs) {
      return false;
    }
    const uint64_t middleNs = startNs + _bitNs / 2;  // of the start bit
    if (idleAt(middleNs)) {
      _fromNs = middleNs;
      continue;
    }
    unsigned bits = 0;
    for (unsigned i = 0; i < stopBit - 1; i++) {
      bits |= static_cast<unsigned>(idleAt(middleNs + uint64_t{1 + i} * _bitNs)) << i;
    }
    const uint64_t stopNs = middleNs + uint64_t{stopBit} * _bitNs;
    character.value = static_cast<uint8_t>(dataOf(bits, _format));
    character.bad =
        !idleAt(stopNs) || (_format.parity != Parity::None && isOdd(bits) != (_format.parity == Parity::Odd));
    character.endUs = (endNs + NsPerUs - 1) / NsPerUs;
    _fromNs = stopNs;
    return true;
  }
}

void UartSampler::level(uint64_t ns, bool high) {
  const bool idle = high != _flipped;
  if (idle != _idle) {
    _idle = idle;
    _edges.push_back({ns, idle});
  }
}

// Only for times after the first edge: what was before it is forgotten.
bool UartSampler::idleAt(uint64_t ns) const {
  bool idle = false;
  for (auto edge = _edges.begin(); edge != _edges.end() && edge->ns <= ns; ++edge) {
    idle = edge->idle;
  }
  return idle;
}

}  // namespace line
