#include "DecodeSBus.tpp"

SBUS_COMPILE_DECODER(sbus::Frame16)

// A stale frame is remembered by its number, since the clock may wrap afterwards; a newer frame may come meanwhile.
bool DecodeSBus::decodeExtraChannels(sbus::ChannelArray<uint16_t, sbus::ProportionalCount> channels) {
  uint32_t number;
  for (;;) {
    number = _finder.counters().extraFrames;
    sbus::barrier();
    if (number == _staleExtra || channels == nullptr) {
      return false;
    }
    if (!_link.isStale(_link.ageOf(_finder.extraTime()))) {
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
