#include "UartSampler.h"

#include <algorithm>

namespace host {

namespace {

constexpr uint64_t NsPerUs = 1000;

bool parityOf(unsigned bits) {
  bool odd = false;
  for (; bits != 0; bits >>= 1) {
    odd ^= (bits & 1) != 0;
  }
  return odd;
}

}  // namespace

void UartSampler::open(uint64_t nowUs, const PortSettings &settings, const Wire &wire) {
  _wire = wire;
  _bitNs = settings.bitNs();
  _dataBits = settings.dataBits();
  _parityBits = settings.parity() == Parity::None ? 0 : 1;
  _stopBits = settings.stopBits();
  _odd = settings.parity() == Parity::Odd;
  _flipped = !settings.agreesWith(wire.polarity);
  _edges.clear();
  _idle = !_flipped;
  _fromNs = nowUs * NsPerUs;
  _knownNs = _fromNs;
}

void UartSampler::put(const Character &character) {
  uint64_t ns = (character.endUs - _wire.characterUs()) * NsPerUs;
  if (ns < _knownNs) {
    return;
  }
  const auto bit = [&](bool high) {
    level(ns, high);
    ns += _wire.bitNs();
  };
  bit(false);
  for (unsigned i = 0; i < 8; i++) {
    bit((character.value >> i & 1) != 0);
  }
  bit(parityOf(character.value) != character.bad);
  bit(true);
  _knownNs = character.endUs * NsPerUs;
}

bool UartSampler::next(uint64_t nowUs, Character &character) {
  // A character that is on its way has not been put, so nothing is known of the time in which it may have begun.
  const uint64_t characterNs = _wire.characterUs() * NsPerUs;
  const uint64_t knownNs = std::max(_knownNs, nowUs * NsPerUs - std::min(nowUs * NsPerUs, characterNs));
  while (true) {
    while (!_edges.empty() && (_edges.front().idle || _edges.front().ns < _fromNs)) {
      _edges.pop_front();
    }
    if (_edges.empty()) {
      return false;
    }
    const uint64_t startNs = _edges.front().ns;
    const unsigned checkedBits = 1 + _dataBits + _parityBits;  // those before the stop bits
    const uint64_t endNs = startNs + uint64_t{checkedBits + _stopBits} * _bitNs;
    if (endNs > knownNs) {
      return false;
    }
    const uint64_t middleNs = startNs + _bitNs / 2;  // of the start bit
    if (idleAt(middleNs)) {
      _fromNs = middleNs;
      continue;
    }
    unsigned bits = 0;
    for (unsigned i = 0; i < _dataBits + _parityBits; i++) {
      bits |= static_cast<unsigned>(idleAt(middleNs + uint64_t{1 + i} * _bitNs)) << i;
    }
    const uint64_t stopNs = middleNs + uint64_t{checkedBits} * _bitNs;
    character.value = static_cast<uint8_t>(bits & ((1u << _dataBits) - 1));
    character.bad = !idleAt(stopNs) || (_parityBits != 0 && parityOf(bits) != _odd);
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

// Only for times behind the first edge: what was before it is forgotten.
bool UartSampler::idleAt(uint64_t ns) const {
  bool idle = false;
  for (auto edge = _edges.begin(); edge != _edges.end() && edge->ns <= ns; ++edge) {
    idle = edge->idle;
  }
  return idle;
}

}  // namespace host
