#include "ImpairedLine.h"

#include <algorithm>

#include "support/Bytes.h"
#include "support/KnownFrames.h"
#include <sbus/Frame.h>

namespace {

// The times of S.BUS2's slots after the end of a frame, as measured on a Futaba R7008SB: PX4-Autopilot,
// sbus2_r7008SB.txt.
constexpr uint32_t FirstSlotUs = 2030;
constexpr uint32_t SlotUs = 660;
constexpr unsigned VoltageUpperBits = 0xC0;  // slot 0 is the receiver's own: its supply or the external voltage
constexpr uint32_t Fasst12SlotUs = 310;
constexpr unsigned SlotsInGroup = 8;
constexpr unsigned Groups = 4;
constexpr double Junk = 1 / 8.;
constexpr uint32_t SilenceUs = 100000;

// Returns 011 and the slot's number, its bits in reverse.
uint8_t slotId(unsigned slot) {
  unsigned id = 0;
  for (unsigned bit = 0; bit < 5; bit++) {
    id |= (slot >> bit & 1) << (7 - bit);
  }
  return static_cast<uint8_t>(id | 3);
}

bool isFrame(const SentFrame &sent) {
  const uint8_t end = sent.bytes[sent.size - 1];
  return sent.bytes[0] == (sent.extra ? sbus::ExtraHeader : sbus::HeaderByte) &&
         sbus::isFlagsByte(sent.bytes[sent.size - 2]) &&
         (sent.size == sbus::FrameSize24 ? end == 0 : sbus::isEndByte(end));
}

uint64_t joinedAfterUs(const Transmission &transmission) {
  const Cut &cut = transmission.cut;
  const uint64_t characterUs = transmission.characterUs() + transmission.spreadUs;
  return cut.swaps ? cut.fromFrame * transmission.periodUs + cut.fromCharacter * characterUs + cut.silenceUs
                   : cut.toFrame * transmission.periodUs + cut.toCharacter * characterUs;
}

}  // namespace

ImpairedLine::ImpairedLine(const Transmission &transmission, uint64_t startUs, Random &random)
    : _transmission(transmission),
      _characterUs(transmission.characterUs()),
      _joinedUs(startUs + joinedAfterUs(transmission)),
      _random(random),
      _sticks(transmission.sticks, random),
      _moreSticks(transmission.sticks, random),
      _framesLeft(transmission.frames),
      _frameUs(startUs),
      _timeUs(startUs) {}

bool ImpairedLine::next(uint64_t nowUs, line::Character &character) {
  if (nextUs() > nowUs) {
    return false;
  }
  character = _characters.front();
  _characters.pop_front();
  return true;
}

bool ImpairedLine::finished(uint64_t /*nowUs*/) const { return _characters.empty() && _framesLeft == 0; }

uint64_t ImpairedLine::nextUs() {
  while (_characters.empty() && _framesLeft != 0) {
    sendFrame();
  }
  return _characters.empty() ? UINT64_MAX : _characters.front().endUs;
}

bool ImpairedLine::nextSent(SentFrame &frame) {
  if (_sent.empty()) {
    return false;
  }
  frame = _sent.front();
  _sent.pop_front();
  return true;
}

void ImpairedLine::sendFrame() {
  _framesLeft--;
  _timeUs = _frameUs;
  if (_transmission.kind == Kind::With2F) {
    sendExtra();
    _timeUs += 600 + _random.below(5400);
  }

  const Frame frame = (_otherSticks ? *_otherSticks : _sticks).next();
  uint8_t bytes[sbus::FrameSize24] = {};
  unsigned size = sbus::FrameSize;
  SentFrame sent;
  std::copy(frame.begin(), frame.end(), bytes);
  if (_transmission.kind == Kind::Sbus2) {
    bytes[sbus::EndIndex] = static_cast<uint8_t>(Sbus2End + (_number % 4 << 4));
  } else if (_transmission.kind == Kind::R7003SB) {
    bytes[sbus::EndIndex] = R7003End;
    const Bytes tail = tailOf(R7003End);
    std::copy(tail.begin(), tail.end(), bytes + size);
    size += static_cast<unsigned>(tail.size());
  } else if (_transmission.kind == Kind::Fasst12) {
    bytes[sbus::EndIndex] = R7003End;
  } else if (_transmission.kind == Kind::Channels24) {
    const Frame more = _moreSticks.next();
    std::copy_n(more.begin() + sbus::PayloadIndex, 11, bytes + sbus::FlagsIndex);
    if (_transmission.sticks == Payload::LowChannel16) {  // CH24 as CH16
      bytes[sbus::FrameSize24 - 3] = frame[sbus::FlagsIndex - 1];
    }
    if (_transmission.sticks == Payload::SlotInside) {
      bytes[sbus::FlagsIndex] = 0;
      bytes[sbus::EndIndex] = static_cast<uint8_t>(Sbus2End | (more[sbus::EndIndex - 1] & 0x30));
      bytes[sbus::FrameSize] = slotId(more[sbus::EndIndex - 2] % 32);
    }
    bytes[sbus::FrameSize24 - 2] = frame[sbus::FlagsIndex];
    bytes[sbus::FrameSize24 - 1] = 0;
    size = sent.size = sbus::FrameSize24;
  }
  if (_transmission.company.strayBefore != Company::NoStray) {
    _timeUs -= _characterUs;
    sendStray(_transmission.company.strayBefore);
  }
  if (_random.chance(_transmission.noiseBefore.probability)) {
    sendNoiseBefore();
  }
  drawSilences(sent.size);
  sendImpaired(bytes, size, sent);
  _sent.push_back(sent);
  sendBetween(bytes[sbus::EndIndex]);
  if (_transmission.cut.swaps && _number == _transmission.cut.fromFrame) {
    swap();
  }
  _number++;
}

void ImpairedLine::sendImpaired(const uint8_t *bytes, unsigned size, SentFrame &sent) {
  const Impairments &impairments = _transmission.impairments;
  bool whole = true;
  for (unsigned i = 0; i < size; i++) {
    uint8_t value = bytes[i];
    if (i != 0) {
      const uint32_t jitterUs = _transmission.jitterUs;
      _timeUs += _transmission.spreadUs + (jitterUs != 0 ? _random.below(jitterUs + 1) : 0);
      _timeUs += i < sent.size ? _silentUs[i] : 0;
    }
    if (_random.chance(impairments.flipped)) {
      const uint32_t one = _random.below(8);
      const uint32_t other = (one + 1 + _random.below(7)) % 8;
      value = static_cast<uint8_t>(value ^ (1u << one | 1u << other));
    }
    bool bad = _random.chance(impairments.dropped);
    if (_timeUs >= _burstEndUs && _random.chance(impairments.burst)) {
      _burstEndUs = _timeUs + (2 + _random.below(11)) * _characterUs;
    }
    if (_timeUs >= _elevenEndUs && _random.chance(impairments.eleven)) {
      _elevenEndUs = _timeUs + 11 * _characterUs;
    }
    bad = bad || _timeUs < _elevenEndUs;
    if (_timeUs < _burstEndUs) {
      bad = !_random.chance(Junk);
      value = _random.byte();
    }
    if (_random.chance(impairments.inserted)) {
      send(_random.byte());
      whole = whole && i == 0;  // in front of the header it does no harm
      _straight = false;
    }
    if (i == 0) {
      sent.first = _good;
      sent.straight = _straight;
    }
    if (isCut(i)) {
      if (_number == _transmission.cut.fromFrame && i == _transmission.cut.fromCharacter) {
        _cutUs = _timeUs;
      }
      _timeUs += _characterUs;
      whole = false;
    } else {
      send(value, bad);
      whole = whole && !bad;
    }
    if (i < sent.size) {
      sent.bytes[i] = value;
      sent.altered = sent.altered || value != bytes[i];
    }
    if (i == sent.size - 1) {
      sent.after = _good;
      sent.endUs = _timeUs;
      sent.intact = whole && isFrame(sent);
      sent.straight = sent.straight && !sent.altered;
    }
  }
  _straight = whole && sent.intact && !sent.altered && (!sent.extra || sent.straight);
}

void ImpairedLine::sendExtra() {
  Frame extra = _moreSticks.next();
  extra[0] = sbus::ExtraHeader;
  SentFrame sent;
  sent.extra = true;
  sendImpaired(extra.data(), sbus::FrameSize, sent);
  sent.straight = false;  // it waits for what follows, at any place
  _sent.push_back(sent);
}

// Sends what is between this frame and the next.
void ImpairedLine::sendBetween(uint8_t end) {
  const uint64_t characters = _characters.size();
  if (_transmission.kind == Kind::Fasst12) {
    const uint64_t slotUs = _timeUs + Fasst12SlotUs;
    const Bytes tail = tailOf(R7003End);
    send(tail.front());
    _timeUs = slotUs;
    std::for_each(tail.begin() + 1, tail.end(), [this](uint8_t value) { send(value); });
  }
  const Company &company = _transmission.company;
  if (company.strayAfter != Company::NoStray) {
    sendStray(company.strayAfter);
  }
  if (company.slots != 0 && (company.afterEach || end == Sbus2End)) {
    sendSlots(_number % Groups);
  }
  uint64_t nextFrameUs = _frameUs + _transmission.periodUs;
  if (const uint32_t unsteadyUs = _transmission.unsteadyUs) {
    nextFrameUs += _random.below(2 * unsteadyUs + 1);
    nextFrameUs -= unsteadyUs;
  }
  if (nextFrameUs > _timeUs + 4 * _characterUs && _random.chance(_transmission.impairments.noise)) {
    _timeUs += _random.below(static_cast<uint32_t>(nextFrameUs - _timeUs - 2 * _characterUs));
    send(_random.byte());
    _noiseCharacters++;
  }
  if (_transmission.kind == Kind::Odd2F && _number % 3 == 1) {
    _timeUs += 600;
    sendExtra();
    nextFrameUs = std::max(nextFrameUs, _timeUs + 1000 + _random.below(3000));
  }
  const bool stops = _transmission.stopEvery != 0 && (_number + 1) % _transmission.stopEvery == 0;
  _straight = _straight && !stops && _characters.size() == characters;
  _frameUs = std::max(nextFrameUs, _timeUs) + (stops ? SilenceUs + _random.below(SilenceUs) : 0);
}

void ImpairedLine::sendSlots(unsigned group) {
  const Company &company = _transmission.company;
  const uint64_t firstUs = _timeUs + FirstSlotUs + static_cast<uint64_t>(static_cast<int64_t>(company.lateUs));
  for (unsigned slot = 0; slot < company.slots; slot++) {
    _timeUs = firstUs + slot * SlotUs;
    const unsigned number = (group + company.group) % Groups * SlotsInGroup + slot;
    uint8_t bytes[] = {slotId(number), _random.byte(), _random.byte()};
    if (number == 0) {
      bytes[1] = static_cast<uint8_t>(VoltageUpperBits | _random.below(8));
    }
    const bool isCut = company.cutSlots > 0 && _random.chance(company.cutSlots);
    const unsigned lost = isCut ? 1 + _random.below(7) : 0;  // bits
    for (unsigned i = 0; i < 3; i++) {
      send(bytes[i], (lost >> i & 1) != 0);
    }
    if (company.breakAfterSlots) {
      send(0, lost == 7);
    }
  }
}

void ImpairedLine::sendStray(int stray) {
  uint8_t value = static_cast<uint8_t>(stray);
  while (stray == Company::AnyStray) {
    value = _random.byte();
    if (value != sbus::HeaderByte && value != sbus::ExtraHeader) {
      break;
    }
  }
  send(value);
  _straight = false;
}

void ImpairedLine::sendNoiseBefore() {
  const NoiseBefore &noise = _transmission.noiseBefore;
  const uint32_t silentUs = noise.leastUs + _random.below(noise.mostUs - noise.leastUs + 1);
  const unsigned count = 1 + _random.below(4);
  const unsigned header = _random.below(2 * count);
  const uint64_t frameUs = _timeUs;
  _timeUs -= silentUs + uint64_t{count} * _characterUs;
  for (unsigned i = 0; i < count; i++) {
    send(i == header ? sbus::HeaderByte : _random.byte());
  }
  _timeUs = frameUs;
  _noiseCharacters += count;
  _straight = false;
}

// Sends a part of a character: never a header or an end byte, with which it would belong to the frame that it touches.
void ImpairedLine::sendFragment() {
  uint8_t value = _random.byte();
  while (value == sbus::HeaderByte || value == sbus::ExtraHeader || sbus::isEndByte(value)) {
    value = _random.byte();
  }
  send(value, _random.chance(0.5));
}

void ImpairedLine::drawSilences(unsigned size) {
  const Silences &silences = _transmission.silences;
  if (silences.count == 0 || (!silences.eachFrame && _number != 0)) {
    return;
  }
  _silentUs.fill(0);
  for (unsigned i = 0; i < silences.count; i++) {
    const unsigned after = silences.after != 0 ? silences.after : 1 + _random.below(size - 1);
    _silentUs[after] = silences.leastUs + _random.below(silences.mostUs - silences.leastUs + 1);
  }
}

// Begins the frames of the other receiver: up to the end of the cut, which may be earlier than now, they are not sent.
void ImpairedLine::swap() {
  const Cut &cut = _transmission.cut;
  _otherSticks.emplace(_transmission.sticks, _random);
  _timeUs = _cutUs;
  if (_random.chance(0.5)) {
    sendFragment();
  }
  const uint64_t joinUs = _timeUs + cut.silenceUs;
  if (cut.silenceUs >= 2 * _characterUs && _random.chance(0.5)) {
    _timeUs = joinUs - _characterUs;
    sendFragment();
  }
  _frameUs = joinUs - uint64_t{cut.toCharacter} * (_characterUs + _transmission.spreadUs);
}

// Returns true if this character of the present frame is cut off.
bool ImpairedLine::isCut(unsigned character) const {
  const Cut &cut = _transmission.cut;
  const uint64_t frame = cut.every != 0 ? _number % cut.every : _number;
  const auto later = static_cast<unsigned>(cut.every != 0 ? _number / cut.every % (sbus::FrameSize - 1) : 0);
  const bool begun = frame > cut.fromFrame || (frame == cut.fromFrame && character >= cut.fromCharacter + later);
  const bool over = frame > cut.toFrame || (frame == cut.toFrame && character >= cut.toCharacter + later);
  return begun && !over;
}

void ImpairedLine::send(uint8_t value, bool bad) {
  _timeUs += _characterUs;
  line::Character character;
  character.endUs = _timeUs;
  character.value = value;
  character.bad = bad;
  _characters.push_back(character);
  if (!bad) {
    _good++;
  }
}
