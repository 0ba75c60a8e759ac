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
  const uint32_t late = now - _last - _period;  // us; wraps if it is not due yet
  if (_sent && now - _last < _period) {
    return false;
  }
  if (_serial.availableForWrite() < sbus::FrameSize) {
    return false;
  }
  uint8_t frame[sbus::FrameSize];
  sbus::pack(frame, channels, failsafe, lostFrame);
  _serial.write(frame, sbus::FrameSize);
  // A pass of loop() late, and the next frame is due as if it had been on time; after more than that, from now on.
  _last = _sent && late < _period ? now - late : now;
  _sent = true;
  return true;
}
