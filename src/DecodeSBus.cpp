#include "DecodeSBus.tpp"

SBUS_COMPILE_DECODER(sbus::Frame16)

// What is found too old is told by its number: the clock may wrap afterwards, and a newer frame may come meanwhile.
bool DecodeSBus::decodeExtraChannels(uint16_t channels[]) {
  for (;;) {
    const uint32_t number = _finder.counters().extraFrames;
    READ_ANEW();
    if (number == _staleExtra) {
      return false;
    }
    const bool isStale = _link.isStale(micros() - _finder.extraTime());
    if (!isStale) {
      sbus::unpackExtra(_finder.extra(), channels);
    }
    READ_ANEW();
    if (number == _finder.counters().extraFrames) {
      if (isStale) {
        _staleExtra = number;
      }
      return !isStale;
    }
  }
}
