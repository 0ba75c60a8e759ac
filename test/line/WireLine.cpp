#include "WireLine.h"

#include <algorithm>

#include <sbus/Frame.h>

namespace {

constexpr uint8_t LongTail[] = {0x00, 0x03, 0xC0, 0x33, 0x00};  // a Futaba R7003SB
constexpr uint8_t Telemetry[] = {0x03, 0xC0, 0x2E};             // PX4-Autopilot, sbus2_r7008SB.txt

}  // namespace

WireLine::WireLine(const Transmission &transmission, uint64_t startUs, Random &random)
    : _transmission(transmission),
      _characterUs(transmission.characterUs()),
      _random(random),
      _sticks(transmission.sticks, random),
      _framesLeft(transmission.frames),
      _frameUs(startUs),
      _timeUs(startUs) {}

bool WireLine::next(uint64_t nowUs, host::Character &character) {
  if (finished(nowUs) || nextUs() > nowUs) {
    return false;
  }
  character = _characters.front();
  _characters.pop_front();
  return true;
}

bool WireLine::finished(uint64_t /*nowUs*/) const {
  return _characters.empty() && _framesLeft == 0;
}

uint64_t WireLine::nextUs() {
  if (_characters.empty() && _framesLeft != 0) {
    sendFrame();
  }
  return _characters.front().endUs;
}

bool WireLine::nextSent(SentFrame &frame) {
  if (_sent.empty()) {
    return false;
  }
  frame = _sent.front();
  _sent.pop_front();
  return true;
}

void WireLine::sendFrame() {
  _framesLeft--;
  _timeUs = _frameUs;

  SentFrame sent;
  sent.bytes = _sticks.next();
  if (_transmission.kind == Kind::Sbus2) {
    sent.bytes[sbus::EndIndex] = static_cast<uint8_t>(sbus::TelemetryEndByte + (_number % 4 << 4));
  } else if (_transmission.kind == Kind::R7003SB) {
    sent.bytes[sbus::EndIndex] = sbus::LongEndByte;
  }
  const uint8_t end = sent.bytes[sbus::EndIndex];
  for (unsigned i = 0; i < sbus::FrameSize; i++) {
    uint8_t &value = sent.bytes[i];
    if (_random.chance(_transmission.impairments.flipped)) {
      const uint32_t one = _random.below(8);
      const uint32_t other = (one + 1 + _random.below(7)) % 8;
      value = static_cast<uint8_t>(value ^ (1u << one | 1u << other));
    }
    if (_random.chance(_transmission.impairments.inserted)) {
      send(_random.byte());
      sent.intact = sent.intact && i == 0;  // in front of the header it does no harm
    }
    if (i == 0) {
      sent.first = _good;
    }
    const bool bad = _random.chance(_transmission.impairments.dropped);
    send(value, bad);
    sent.intact = sent.intact && !bad;
  }
  sent.behind = _good;
  sent.intact = sent.intact && sbus::isFrame(sent.bytes.data());
  _sent.push_back(sent);

  sendTail(end);
  uint64_t nextFrameUs = _frameUs + _transmission.periodUs;
  sendNoise(nextFrameUs);
  if (_transmission.kind == Kind::Further && _number % 3 == 1) {
    nextFrameUs = sendFurther(nextFrameUs);
  }
  _frameUs = std::max(nextFrameUs, _timeUs);
  _number++;
}

void WireLine::sendTail(uint8_t end) {
  if (_transmission.kind == Kind::R7003SB) {
    for (const uint8_t value : LongTail) {
      send(value, _random.chance(_transmission.impairments.dropped));
    }
  } else if (_transmission.kind == Kind::Sbus2 && end == sbus::TelemetryEndByte && _number % 8 == 0) {
    _timeUs += 2000;
    for (const uint8_t value : Telemetry) {
      send(value);
    }
  }
}

void WireLine::sendNoise(uint64_t nextFrameUs) {
  if (nextFrameUs > _timeUs + 4 * _characterUs && _random.chance(_transmission.impairments.noise)) {
    const auto roomUs = static_cast<uint32_t>(nextFrameUs - _timeUs - 2 * _characterUs);
    _timeUs += _random.time(roomUs, _transmission.grainUs);
    send(_random.byte());
    _noiseCharacters++;
  }
}

uint64_t WireLine::sendFurther(uint64_t nextFrameUs) {
  _timeUs += 600;
  const bool is2F = _number % 2 == 1;
  send(is2F ? 0x2F : sbus::HeaderByte);
  for (unsigned i = 1; i < (is2F ? 25 : 36); i++) {
    send(_random.byte());
  }
  return _timeUs + 1000 > nextFrameUs ? _timeUs + 1000 + _random.below(3000) : nextFrameUs;
}

void WireLine::send(uint8_t value, bool bad) {
  _timeUs += _characterUs;
  host::Character character;
  character.endUs = _timeUs;
  character.value = value;
  character.bad = bad;
  _characters.push_back(character);
  if (!bad) {
    _good++;
  }
}
