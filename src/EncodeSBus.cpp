#include "EncodeSBus.h"

void EncodeSBus::begin(unsigned long baud) {
  begin(baud, sbus::PortConfig);
}

void EncodeSBus::begin(unsigned long baud, uint32_t config) {
  _sent = false;
  sbus::open(_serial, &HardwareSerial::begin, baud, config);
}

void EncodeSBus::end() {
  _serial.end();
}

bool EncodeSBus::write(const uint16_t channels[], bool failsafe, bool lostFrame) {
  const uint32_t now = micros();
  const uint32_t late = now - _last - _period;  // us; wraps if it is too early
  if (_sent && now - _last < _period) {
    return false;
  }
  if (_serial.availableForWrite() < sbus::FrameSize) {
    return false;
  }
  uint8_t frame[sbus::FrameSize];
  sbus::pack(frame, channels, failsafe, lostFrame);
  _serial.write(frame, sbus::FrameSize);
  // A little late, and the next frame is expected as if this one had been on time; else from now on. So no pause
  // between two frames is shorter than half of what it should be: receivers need them.
  constexpr uint32_t FrameTime = uint32_t{sbus::FrameSize} * sbus::CharacterTime;
  const uint32_t tolerable = _period > FrameTime ? (_period - FrameTime) / 2 : 0;
  _last = _sent && late < tolerable ? now - late : now;
  _sent = true;
  return true;
}
