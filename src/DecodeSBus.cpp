#include "DecodeSBus.tpp"

SBUS_COMPILE_DECODER(sbus::Frame16)

// A stale frame is remembered by its number, since the clock may wrap afterwards; a newer frame may come meanwhile.
bool DecodeSBus::decodeExtraChannels(uint16_t channels[]) {
  uint32_t number;
  for (;;) {
    number = _finder.counters().extraFrames;
    sbus::barrier();
    if (number == _staleExtra) {
      return false;
    }
    if (!_link.isStale(micros() - _finder.extraTime())) {
      break;
    }
    sbus::barrier();
    if (number == _finder.counters().extraFrames) {
      _staleExtra = number;
    }
  }
  do {
    number = _finder.counters().extraFrames;
    sbus::barrier();
    sbus::unpackExtra(_finder.extra(), channels);
    sbus::barrier();
  } while (number != _finder.counters().extraFrames);
  return true;
}
