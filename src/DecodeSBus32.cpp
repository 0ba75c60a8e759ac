#include "DecodeSBus.tpp"

SBUS_COMPILE_DECODER(sbus::Frame16Extra, sbus::ExtraFrame)

// A stale frame is remembered by its number, since the clock may wrap afterwards; a newer frame may come meanwhile.
bool DecodeSBus32::decodeExtraChannels(sbus::ChannelArray<uint16_t, sbus::ProportionalCount> channels) {
  sbus::ExtraFrame &extra = _finder.events();
  uint32_t number;
  for (;;) {
    number = extra.count();
    sbus::barrier();
    if (extra.isForgotten() || channels == nullptr) {
      return false;
    }
    if (!_link.isStale(_link.ageOf(extra.time()))) {
      break;
    }
    sbus::barrier();
    if (number == extra.count()) {
      extra.forget(number);
    }
  }
  do {
    number = extra.count();
    sbus::barrier();
    sbus::unpackExtra(extra.bytes(), channels);
    sbus::barrier();
  } while (number != extra.count());
  return true;
}
