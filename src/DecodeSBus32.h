/// @file
/// Decodes Futaba's FASSTest 26: sixteen channels, two switches, and CH17..CH32.
#pragma once

#include "DecodeSBus.h"
#include "sbus/ExtraFrame.h"

/// Decodes like DecodeSBus, and also the extra channels of Futaba's FASSTest 26, CH17..CH32.
template <typename Polling>
class DecodeSBus32Of : public DecodeSBusOf<sbus::Frame16Extra, sbus::ExtraFrame, Polling> {
  using Decoder = DecodeSBusOf<sbus::Frame16Extra, sbus::ExtraFrame, Polling>;

 public:
  template <typename Other>
  using PolledBy = DecodeSBus32Of<Other>;  ///< see DecodeSBusOf
  using Decoder::Decoder;                  ///< see DecodeSBusOf()

  /// Writes the newest CH17..CH32 to `channels`, 16 values, 0..2047: they come in separate frames. Returns true if such
  /// a frame came within the timeout; otherwise `channels` is unchanged. The flags and switches are those of
  /// decodeSBusFrame(). Call it at least once an hour.
  bool decodeExtraChannels(sbus::ChannelArray<uint16_t, sbus::ProportionalCount> channels) {
    const typename Decoder::Lock lock(*this);
    sbus::ExtraFrame &extra = this->_finder.events();
    uint32_t number;
    for (;;) {  // a stale frame is remembered by its number, since the clock may wrap; a newer one may come meanwhile
      number = extra.count();
      sbus::barrier();
      if (extra.isForgotten() || channels == nullptr) {
        return false;
      }
      if (!this->_link.isStale(this->_link.ageOf(extra.time()))) {
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
};

/// Decodes sixteen channels, two switches, and CH17..CH32.
using DecodeSBus32 = DecodeSBus32Of<sbus::PolledByLoop>;
