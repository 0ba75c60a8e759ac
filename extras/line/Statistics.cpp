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

void Statistics::add(const Stretch &frame) {
  std::array<uint8_t, sbus::FrameSize24> bytes{};
  std::transform(frame.characters.begin(), frame.characters.end(), bytes.begin(),
                 [](const Character &character) { return character.value; });
  if (frame.kind == Stretch::Kind::Extra) {
    sbus::unpackExtra(bytes.data(), &_newest.raw[sbus::ProportionalCount]);
    _newest.count = static_cast<unsigned>(_newest.raw.size());
    return mark(sbus::ProportionalCount, sbus::ProportionalCount);
  }
  const bool is24 = frame.kind == Stretch::Kind::Frame24;
  const size_t count = is24 ? sbus::ChannelCount24 : sbus::ProportionalCount;
  const uint8_t flags = bytes[frame.characters.size() - 2];
  std::array<uint16_t, sbus::ChannelCount24> channels;
  is24 ? sbus::unpack24(bytes.data(), channels.data()) : sbus::unpack(bytes.data(), channels.data());
  std::copy_n(channels.begin(), count, _newest.raw.begin());
  _newest.count = std::max(static_cast<unsigned>(count), is24 ? 0 : _newest.count);
  _newest = withFlags(_newest, flags);
  _newest.switches = is24 ? std::array<bool, 2>{} : _newest.switches;
  _newest.endUs = frame.endUs();
  _pulseless += _newest.hasNoPulses();
  mark(0, count);
  Arrivals::add(frame.endUs(), flags);
}

void Statistics::mark(size_t first, size_t count) {
  for (size_t i = first; i < first + count && !_newest.lostFrame && !_newest.failsafe; i++) {
    _travel[i].add(_newest.raw[i]);
  }
}

void Statistics::resetMarks() {
  Arrivals::resetMarks();
  _travel.fill(Extent());
}

}  // namespace line
