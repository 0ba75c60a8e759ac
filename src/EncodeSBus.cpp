#include "EncodeSBus.h"

void EncodeSBus::begin(unsigned long baud, uint32_t config) {
  _sent = false;
  _port.open(baud, config);
}

void EncodeSBus::end() {
  _port.close();
}

bool EncodeSBus::write(const uint16_t channels[], bool failsafe, bool lostFrame) {
  const uint32_t now = micros();
  const uint32_t late = now - _last - _period;  // us; wraps if it is too early
  if (_sent && now - _last < _period) {
    return false;
  }
  // Some ports never take 25 bytes, and some cannot say: then as many as they have ever taken are enough.
  const int room = _port.room();
  if (room > _room) {
    _room = static_cast<uint8_t>(room < sbus::FrameSize ? room : sbus::FrameSize);
  } else if (room < _room) {
    return false;
  }
  uint8_t frame[sbus::FrameSize];
  sbus::pack(frame, channels, failsafe, lostFrame);
  _port.write(frame, sbus::FrameSize);
  // A little late, and the next frame is expected as if this one had been on time; else from now on. So no pause
  // between two frames is shorter than half of what it should be: receivers need them.
  constexpr uint32_t FrameTime = uint32_t{sbus::FrameSize} * sbus::CharacterTime;
  const uint32_t tolerable = _period > FrameTime ? (_period - FrameTime) / 2 : 0;
  _last = _sent && late < tolerable ? now - late : now;
  _sent = true;
  return true;
}
