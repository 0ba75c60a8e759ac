#include "line/capture/WireDecoder.h"

#include <algorithm>

#include "line/capture/Parsing.h"

namespace line {

namespace {

constexpr int64_t Never = INT64_MAX / 2;

// Returns why there is no frame among characters decoded by an analyser.
std::string whyNoCharacters(const FoundWire &wire) {
  return "has " + std::to_string(wire.good) + " good characters and " + std::to_string(wire.bad) +
         " with errors: is the analyser set to the baud rate, 8 bits, even parity, 2 stop bits and inverted?";
}

}  // namespace

void WireDecoder::signals(const std::vector<std::string> &names) {
  for (const std::string &name : names) {
    const std::string inQuotes = quoted(name);
    _names.push_back(inQuotes.substr(1, inQuotes.size() - 2));
  }
  for (size_t i = 0; i < names.size(); i++) {
    _collected.emplace_back(_keptMax / names.size());
  }
}

void WireDecoder::collect(size_t signal, int64_t ns, bool high) {
  constexpr int64_t GapNs = 200000;  // longer than the bits of a character that are alike
  Collected &collected = _collected[signal];
  std::vector<Level> &sample = collected.sample;
  if (!isWanted(signal) || (!sample.empty() && sample.back().high == high)) {
    return;
  }
  sample.push_back({ns, high});
  // If they are too many, those of the sample count, from a gap on.
  const auto isGap = [](const Level &level, const Level &next) { return next.ns - level.ns >= GapNs; };
  if (!collected.kept.isWhole() && isGap(*(sample.end() - 2), sample.back())) {
    auto level = std::adjacent_find(sample.begin(), sample.end(), isGap);
    collected.fromNs = level->ns;
    collected.kept = EdgeStore(_keptMax / _names.size());
    for (; level != sample.end(); ++level) {
      collected.kept.put(level->ns, level->high);
    }
  } else {
    collected.kept.put(ns, high);
  }
  if (sample.size() < SampleMax) {
    return;
  }
  if (findWire(sample, _overrides).frames > 0) {
    choose();
  } else {
    sample.erase(sample.begin(), sample.begin() + SampleMax / 2);
  }
}

void WireDecoder::choose() {
  for (size_t i = 0; i < _collected.size(); i++) {
    const FoundWire wire = findWire(_collected[i].sample, _overrides);
    if (wire.frames == 0) {
      continue;
    }
    const bool better = wire.betterThan(_wire);
    if (_wire.frames > 0) {
      _others.push_back(_names[better ? _chosen : i]);
    }
    if (better) {
      _wire = wire;
      _chosen = i;
    }
  }
  if (_wire.frames > 0) {
    begin();
  }
}

// Decodes the only signal even without a frame: bits copied from an oscilloscope's picture may be less than one.
void WireDecoder::chooseOnly() {
  if (_overrides.signal.empty() && _collected.size() != 1) {
    return;
  }
  for (size_t i = 0; i < _collected.size(); i++) {
    const std::vector<Level> &sample = _collected[i].sample;
    const FoundWire wire = findWire(sample, _overrides);
    if (isWanted(i) && wire.hasCharacters() && (_overrides.baud != 0 || hasBits(sample))) {
      _wire = wire;
      _chosen = i;
      begin();
      return;
    }
  }
}

void WireDecoder::begin() {
  _decoder.emplace(_wire.settings, _wire.bitNs);
  _onFound();
  const Collected &chosen = _collected[_chosen];
  if (chosen.kept.isWhole()) {
    _decodedNs = chosen.fromNs;
    chosen.kept.each(INT64_MIN, INT64_MAX, [this](int64_t ns, bool high) { decode(ns, high); });
  } else {
    _decodedNs = chosen.sample.front().ns;
    for (const Level &level : chosen.sample) {
      decode(level.ns, level.high);
    }
  }
  _collected.clear();
}

std::string WireDecoder::note() const {
  return _decodedNs == INT64_MIN ? ""
                                 : "decoded from " + std::to_string(_decodedNs / 1000) +
                                       " us on: the edges before that have no frame, and are too many to be kept";
}

void WireDecoder::finish(int64_t endNs, bool cutOff) {
  if (!_decoder) {
    choose();
  }
  if (!_decoder) {
    chooseOnly();
  }
  if (!_decoder) {
    return;
  }
  _captureEndNs = endNs;
  const bool goesOn = _lastNs >= endNs && !cutOff;
  _endNs = endNs + (goesOn ? static_cast<int64_t>(EndSilenceUs) * 1000 : 0);
  if (_decoder->until(goesOn ? Never : endNs, _character) && !(goesOn && _character.bad())) {
    _onCharacter(_character);
  }
}

std::string WireDecoder::failure(double periodNs) const {
  const std::string &wanted = _overrides.signal;
  if (!wanted.empty() && std::find(_names.begin(), _names.end(), wanted) == _names.end()) {
    return "there is no signal " + wanted + ": one of " + someNames() + " is expected";
  }
  // If there are many signals, names only some: those with pulses, if there are any.
  size_t told = 0;
  std::string reasons;
  for (size_t i = 0; i < _names.size() && told < Shown; i++) {
    const std::vector<Level> &sample = _collected[i].sample;
    if (isWanted(i) && (hasPulses(sample) || _names.size() == 1 || !wanted.empty())) {
      const FoundWire wire = findWire(sample, _overrides);
      reasons += (told > 0 ? "; signal " : "signal ") + _names[i] + " " +
                 (_isMeasured ? whyNotFound(sample, wire, periodNs) : whyNoCharacters(wire));
      told++;
    }
  }
  reasons = told > 0 ? reasons : "no signal has pulses: is the probe on S-BUS_OUT, and the receiver on?";
  return reasons + (reasons.back() == '?' ? "" : ".") + " No signal has a frame of S.Bus: " + FrameForm;
}

std::string WireDecoder::someNames() const {
  std::string names;
  for (size_t i = 0; i < _names.size() && i < Shown; i++) {
    names += (i > 0 ? ", " : "") + _names[i];
  }
  return names + (_names.size() > Shown ? ", ..." : "");
}

}  // namespace line
