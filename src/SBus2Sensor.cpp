#include "SBus2Sensor.h"

#include "DecodeSBus.tpp"
#include "sbus/FrameFinder.tpp"

SBUS_COMPILE_FINDER(sbus::Frame16, sbus::Answers)
SBUS_COMPILE_DECODER(sbus::Frame16, sbus::Answers)

// A poll shortly before a slot waits for its start: delayMicroseconds() is exact to some us, the next poll is not.
void SBus2Sensor::parseSBusFrame() {
  constexpr int32_t LongestWait = 100;  // us
  receive();
  if (!_finder.events().isPlanned()) {
    return;
  }
  const uint32_t now = micros();
  const int32_t until = static_cast<int32_t>(_finder.events().due() - now);
  if (until > LongestWait) {
    return;
  }
  if (until > 0) {
    delayMicroseconds(static_cast<unsigned>(until));
  }
  answer(until > 0 ? _finder.events().due() : now);
}

// The port is asked first, and the time read then: what it has found was there by then. What comes while it is read may be
// the frame's end, at a time that nobody knows.
void SBus2Sensor::receive() {
  const int waiting = _port.available();
  const uint32_t by = micros();
  Decoder::parseSBusFrame();
  sbus::Answers &answers = _finder.events();
  if (!answers.takeFrameEnd() || !_finder.isEmpty()) {
    return;
  }
  uint32_t after = by - UINT16_MAX;
  if (_handOver != sbus::HandOver::Unknown && waiting > 0 && _finder.found() == static_cast<unsigned>(waiting)) {
    after = _finder.pollBefore();
  }
  const sbus::Lag lag = sbus::lagOf(_handOver, static_cast<unsigned>(waiting));
  answers.plan(after - static_cast<uint32_t>(lag.most), by - static_cast<uint32_t>(lag.least));
}

void SBus2Sensor::answer(uint32_t now) {
  uint8_t characters[sbus::SlotSize];
  if (_finder.events().start(now, characters)) {
    _port.write(characters, sizeof characters);
  }
}
