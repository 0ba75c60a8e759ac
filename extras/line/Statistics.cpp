#include "line/Statistics.h"

namespace line {

void Extent::add(uint64_t value) {
  low = count == 0 ? value : std::min(low, value);
  high = count == 0 ? value : std::max(high, value);
  sum += value;
  count++;
}

void Arrivals::add(uint64_t nowUs, uint8_t flags) {
  if (_link.seen()) {
    _gaps.add(nowUs - _newestUs);
  }
  _newestUs = nowUs;
  _link.frame(flags);
  const sbus::LinkState link = inFailsafe() ? sbus::LinkState::Failsafe : sbus::LinkState::Ok;
  _held.frame(nowUs, flags, link, _askedUs);
}

sbus::LinkState Arrivals::state(uint64_t nowUs) {
  _askedUs = std::max({_askedUs, nowUs, _newestUs});
  return _link.state(static_cast<uint32_t>(_newestUs), static_cast<uint32_t>(_askedUs));
}

Values withFlags(Values values, uint8_t flagsByte) {
  values.switches = {(flagsByte & sbus::FlagChannel17) != 0, (flagsByte & sbus::FlagChannel18) != 0};
  values.lostFrame = (flagsByte & sbus::FlagLostFrame) != 0;
  values.failsafe = (flagsByte & sbus::FlagFailsafe) != 0;
  return values;
}

// A header 0F that noise turns into 2F makes no line of 32 channels. But the first frame on a line lacks no channels:
// the one with header 2F before it counts for it alone.
void Statistics::add(const Stretch &frame) {
  std::array<uint8_t, sbus::FrameSize24> bytes{};
  std::transform(frame.characters.begin(), frame.characters.end(), bytes.begin(),
                 [](const Character &character) { return character.value; });
  _variant.take(frame.kind, bytes[frame.characters.size() - 1]);
  if (frame.kind == Stretch::Kind::Extra) {
    sbus::unpackExtra(bytes.data(), &_newest.raw[sbus::ProportionalCount]);
    _has32 = _has32 || _sinceExtra < ExtraWithin;
    _sinceExtra = 0;
    return;
  }
  const bool is24 = frame.kind == Stretch::Kind::Frame24;
  _has32 = _has32 && _sinceExtra < NoExtra;
  const bool is32 = _has32 || (_newest.count == 0 && _sinceExtra == 0);
  _sinceExtra = std::min(_sinceExtra + 1, NoExtra);
  const uint8_t flags = bytes[frame.characters.size() - 2];
  is24 ? sbus::unpack24(bytes.data(), _newest.raw.data()) : sbus::unpackExtra(bytes.data(), _newest.raw.data());
  _newest = withFlags(_newest, flags);
  _newest.count = is24 ? sbus::ChannelCount24 : is32 ? 2 * sbus::ProportionalCount : sbus::ProportionalCount;
  _newest.switches = is24 ? std::array<bool, 2>{} : _newest.switches;
  _newest.endUs = frame.endUs();
  _pulseless += _newest.hasNoPulses();
  _jumped = _jumps.put(_newest.endUs, _newest.raw.data(), _newest.count, !_newest.failsafe && !_newest.hasNoPulses());
  _jumpCount += _jumped != 0;
  for (size_t i = 0; i < _newest.count && !_newest.lostFrame && !_newest.failsafe; i++) {
    _travel[i].add(_newest.raw[i]);
  }
  Arrivals::add(frame.endUs(), flags);
}

void Statistics::resetMarks() {
  Arrivals::resetMarks();
  _travel.fill(Extent());
}

}  // namespace line
