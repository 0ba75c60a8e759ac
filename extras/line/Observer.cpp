#include "line/Observer.h"

#include <algorithm>

#include "line/Format.h"

namespace line {

namespace {

constexpr uint64_t GapCharacters = 8;

// Returns us - lessUs, or 0 if that is negative.
constexpr uint64_t difference(uint64_t us, uint64_t lessUs) { return us - std::min(us, lessUs); }

}  // namespace

void Observer::reset(uint64_t nowUs, uint32_t characterUs) {
  static_cast<Statistics &>(*this) = Statistics();
  _decoders.reset(nowUs, characterUs);
  _segments.reset(characterUs);
  _telemetry = TelemetrySlots();
  _protocols = sbus::OtherProtocols();
  _faults = SenderFaults();
  _readAt = ReadAtBaud();
  _packets = sbus::PacketShape();
  _packetPeriods = Extent();
  _packetUs = nowUs;
  _rhythm = sbus::FlagRhythm();
  _characterUs = characterUs;
  _last = Character();
  _last.endUs = nowUs;
  _lineUs = nowUs;
  _silenceUs = 0;
  _waits = false;
  _characterErrors = 0;
  _quality = sbus::LinkQuality();
  _percent = 0;
  _emittedUs = 0;
  _first = Stretch();
  _joinsAtExtra = 0;
}

sbus::Counters Observer::counters() const { return withJoins(_decoders.counters()); }

sbus::Counters Observer::counters16() const {
  sbus::Counters counters = withJoins(_decoders.counters16());
  counters.otherSizeFrames = variant().frames24();
  return counters;
}

// Counts the frames with header 2F at which the line was joined, and which a decoder discarded.
sbus::Counters Observer::withJoins(sbus::Counters counters) const {
  counters.extraFrames += _joinsAtExtra;
  counters.rejectedByLength -= std::min(counters.rejectedByLength, _joinsAtExtra);
  counters.discardedBytes -= std::min<uint32_t>(counters.discardedBytes, sbus::FrameSize * _joinsAtExtra);
  return counters;
}

unsigned long Observer::discardedBytes() const {
  const unsigned long all = counters().discardedBytes;
  return all - std::min(all, _telemetry.characters());
}

std::string Observer::frames() const {
  const uint32_t all = counters().frames, of24 = variant().frames24();
  return std::to_string(all) + (all == 1 ? " frame" : " frames") +
         (of24 == 0 ? "" : (variant().frames16() == 0 ? "" : ", " + std::to_string(of24)) + " of 24 channels");
}

unsigned Observer::linkQuality(uint64_t nowUs) { return state(nowUs) == sbus::LinkState::Stale ? 0 : _percent; }

sbus::Finding Observer::senderFault() const {
  const sbus::Finding sender = _faults.found();
  const sbus::Finding packets = _packets.found();
  return sender != sbus::Finding::NoSignal && sender != sbus::Finding::SevenBits ? sender
         : packets != sbus::Finding::NoSignal                                    ? packets
         : sender == sbus::Finding::NoSignal && _rhythm.isSteady()               ? sbus::Finding::LostInTurn
                                                                                 : sender;
}

std::string Observer::packets() const {
  if (_packets.found() == sbus::Finding::NoSignal) {
    return {};
  }
  const sbus::PacketForm &form = _packets.form();
  std::string text =
      format("Packets: %u bytes from %02X to %02X, one every %.1f ms", unsigned{form.size}, unsigned{form.first},
             unsigned{form.last}, static_cast<double>(_packetPeriods.mean()) / 1000);
  if (form.size != sbus::FrameSize) {
    text += "; a frame has 25 bytes";
  }
  if ((form.first & sbus::HeaderMask) != sbus::HeaderByte) {
    text += form.first == 0xF0 ? "; a frame begins with 0F: the lowest bit of a byte is sent first"
                               : "; a frame begins with 0F";
  }
  if (form.size == sbus::FrameSize && !sbus::isEndByte(form.last)) {
    text += "; a frame ends with 00";
  }
  if (form.size == sbus::FrameSize && !sbus::isFlagsByte(form.flags)) {
    text += format("; the flags are %02X, where a frame has 0 in bits 4 to 7", unsigned{form.flags});
  }
  return text + ".";
}

void Observer::takeGap(uint64_t startUs) {
  _packets.gap();
  if (_packetUs > 0) {
    _packetPeriods.add(startUs - _packetUs);
  }
  _packetUs = startUs;
}

void Observer::put(const Character &character) {
  const uint64_t startUs = difference(character.endUs, _characterUs + character.lateUs);
  idleUntil(startUs);
  if (startUs >= _last.endUs + GapCharacters * _characterUs) {
    takeGap(startUs);
  }
  if (character.bad) {
    _packets.spoil();
  }
  _packets.put(character.value);
  _lineUs += _silenceUs + _characterUs;
  _silenceUs = 0;
  _last = character;
  if (newest().count == 0) {
    _protocols.put(character.value);
  }
  _faults.put(character);
  _readAt.put(character.value);
  _waits = !character.bad;
  _characterErrors += character.bad;
  _segments.put(character);
}

void Observer::idleUntil(uint64_t nowUs) {
  const uint64_t silenceUs = difference(nowUs, _last.endUs);
  handOver();
  _silenceUs = std::max(_silenceUs, silenceUs);
  _segments.cut(_decoders.idle(_lineUs + _silenceUs));
  _segments.cutBefore(_decoders.openAt(_segments.end()), _last.endUs + _silenceUs);
}

// If whole frames wait for the next bytes, lets silence follow. (After part of a frame this would count an impaired
// frame.)
void Observer::finish() {
  constexpr uint64_t SilenceUs = 10000;
  handOver();
  const uint64_t open = _segments.end() - _decoders.openAt(_segments.end());
  if (open > 0 && (open % sbus::FrameSize == 0 || open % sbus::FrameSize24 == 0)) {
    _segments.cut(_decoders.idle(_lineUs + _silenceUs + SilenceUs));
  }
  _segments.cut(_decoders.finish());
  _segments.finish();
  emitFirst();
  _telemetry.finish();
}

void Observer::handOver() {
  if (std::exchange(_waits, false)) {
    _segments.cut(_decoders.put(_last.value, _segments.end() - 1, _lineUs, _last.lateUs > 0));
  }
}

// In FASSTest 26 a frame with header 2F comes before each frame. A decoder rejects the first one, and the first one
// after a silence, since it does not know the line yet.
void Observer::take(Stretch &stretch) {
  if (!_first.characters.empty()) {
    if (stretch.kind == Stretch::Kind::Frame) {
      _joinsAtExtra++;
      _first.kind = Stretch::Kind::Extra;
    }
    emitFirst();
  }
  if (stretch.kind == Stretch::Kind::NoFrame && isExtraAlone(stretch)) {
    _first = stretch;
  } else {
    emit(stretch);
  }
}

void Observer::emitFirst() {
  if (!_first.characters.empty()) {
    emit(_first);
    _first = Stretch();
  }
}

// Returns true if the stretch looks like a frame after a gap, and is the first on the line or after a silence.
bool Observer::isExtraAlone(const Stretch &stretch) const {
  constexpr uint64_t SilenceUs = 50000;  // after this a decoder is no longer in sync
  const auto &characters = stretch.characters;
  const uint64_t gapEndUs = _emittedUs == 0 ? 0 : _emittedUs + (GapCharacters + 1) * _characterUs;
  const uint64_t silenceEndUs = _emittedUs + SilenceUs + sbus::FrameSize * uint64_t{_characterUs};
  const bool isFirst = newest().count == 0 || stretch.endUs() >= silenceEndUs;
  return isFirst && characters.size() == sbus::FrameSize && characters.front().value == sbus::ExtraHeader &&
         characters.front().endUs >= gapEndUs && sbus::isEndByte(characters.back().value) &&
         sbus::isFlagsByte(characters[sbus::FrameSize - 2].value) &&
         std::none_of(characters.begin(), characters.end(), [](const Character &c) { return c.bad || c.lateUs > 0; });
}

void Observer::emit(Stretch &stretch) {
  _emittedUs = stretch.endUs();
  if (stretch.isFrame()) {
    add(stretch);
    if (stretch.kind != Stretch::Kind::Extra) {
      _rhythm.put(newest().lostFrame);
    }
    _percent = _quality.update(counters(), state(stretch.endUs()), static_cast<uint32_t>(stretch.endUs()));
  } else {
    for (const Rejected &rejected : _decoders.places().rejections) {
      if (rejected.at >= stretch.at && rejected.at < stretch.at + stretch.characters.size()) {
        stretch.rejected.push_back({rejected.at - stretch.at, rejected.why});
      }
    }
    stretch.slots = _telemetry.slotsIn(stretch);
  }
  _telemetry.put(stretch);
  if (_listener) {
    _listener(stretch);
  }
}

}  // namespace line
