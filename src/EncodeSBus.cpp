#include "EncodeSBus.h"

template <typename Format>
void EncodeSBusOf<Format>::begin(unsigned long baud, uint32_t config) {
  _sent = false;
  _port.open(baud, config);
}

template <typename Format>
void EncodeSBusOf<Format>::end() {
  _port.close();
}

template <typename Format>
bool EncodeSBusOf<Format>::write(sbus::ChannelArray<const uint16_t, Format::Channels> channels, bool failsafe,
                                 bool lostFrame) {
  const uint32_t now = micros();
  const uint32_t late = now - _last - _period;  // us; wraps if it is early
  if ((_sent && now - _last < _period) || channels == nullptr) {
    return false;
  }
  // Some ports never have room for 25 bytes, and some report none: then the largest room seen is enough.
  const int room = _port.room();
  if (room > _room) {
    _room = static_cast<uint8_t>(room < Format::Size ? room : Format::Size);
  } else if (room < _room) {
    return false;
  }
  uint8_t frame[Format::Size];
  Format::pack(frame, channels, failsafe, lostFrame);
  if (!_port.write(frame, Format::Size)) {
    return false;
  }
  // If this frame is a little late, the next one is due as if it had been on time; otherwise a period from now. So no
  // gap is shorter than half of what the period gives: receivers need it.
  constexpr uint32_t FrameTime = uint32_t{Format::Size} * sbus::CharacterTime;
  const uint32_t tolerable = _period > FrameTime ? (_period - FrameTime) / 2 : 0;
  _last = _sent && late < tolerable ? now - late : now;
  _sent = true;
  return true;
}

template class EncodeSBusOf<sbus::Frame16>;
template class EncodeSBusOf<sbus::Frame24>;
