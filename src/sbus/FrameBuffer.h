/// @file
/// Where the bytes of a line come in: two frames' places that take turns, so that no frame is ever copied.
#pragma once

#include <stdint.h>
#include <string.h>

#include "Frame.h"

namespace sbus {

/// The bytes that have come in and belong to no frame yet, where the newest gap lies among them, and the last complete
/// frame. The payloads of both stand at a word, as Format::unpack() needs them.
template <typename Format>
class FrameBuffer {
 public:
  static constexpr uint8_t Nowhere = 0xFF;  ///< no gap is known

  FrameBuffer() {}
  FrameBuffer(const FrameBuffer &) = delete;             ///< its pointers lead into itself
  FrameBuffer &operator=(const FrameBuffer &) = delete;  ///< for the same reason

  uint8_t *space() { return _incoming + _filled; }    ///< where the next bytes go
  int room() const { return Capacity - _filled; }     ///< how many fit there: 1 or more
  /// `count` bytes were written to space().
  void received(int count) { _filled = static_cast<uint8_t>(_filled + count); }

  int filled() const { return _filled; }                            ///< bytes of the incoming frame
  uint8_t *bytes() { return _incoming; }                            ///< the incoming frame, filled() bytes
  const uint8_t *bytes() const { return _incoming; }                ///< the same
  uint8_t operator[](int index) const { return _incoming[index]; }  ///< a byte of it
  /// A header stands there.
  bool isHeader(int index) const { return isHeaderByte<Format>(_incoming[index]); }

  /// The index of the first byte after the newest gap, 0..filled(); or Nowhere.
  int gapAt() const { return _gapAt; }
  bool isGapCertain() const { return _gapCertain; }  ///< else loop() may have been blocked
  /// The next byte is the first after a gap.
  void markGap(bool isCertain) {
    _gapAt = _filled;
    _gapCertain = isCertain;
  }

  /// Forgets the incoming frame.
  void clear() {
    _filled = 0;
    _gapAt = Nowhere;
  }

  /// The first bytes leave. Those left stay where they are until moveTo().
  void drop(int count) {
    _incoming += count;
    forget(count);
  }

  /// Moves what is left to `beginning`, where bytes() stood: once a search, not once a rejected header.
  void moveTo(uint8_t *beginning) {
    const uint8_t *const left = _incoming;
    if (left == beginning) {
      return;
    }
    _incoming = beginning;
    const int count = _filled;
    for (int i = 0; i < count; i++) {  // 100 cycles quicker than memmove()
      beginning[i] = left[i];
    }
  }

  /// The first bytes are a frame, and stand at the place's beginning. What follows goes on in the other place.
  const uint8_t *complete() {
    uint8_t *const frame = _incoming;
    _incoming = _newest;
    _newest = frame;
    forget(Format::Size);
    if (_filled != 0) {
      memcpy(_incoming, frame + Format::Size, _filled);
    }
    return frame;
  }

  /// The last complete frame; of no meaning before the first.
  const uint8_t *newest() const { return _newest; }

 private:
  static constexpr int Pad = 3;  // before a frame: its payload then stands at a word
  // A frame, its tail, and enough to tell what follows; so many that the other place's payload stands at a word, too.
  static constexpr int Capacity = (Pad + Format::Size + LongestTail + 10) / 4 * 4 - Pad;

  __attribute__((always_inline)) void forget(int count) {
    _filled = static_cast<uint8_t>(_filled - count);
    const uint8_t gapAt = static_cast<uint8_t>(_gapAt - count);
    _gapAt = gapAt > Capacity ? Nowhere : gapAt;  // below 0, or Nowhere less `count`: both are far above, as bytes
  }

  // The first three are the first place's pad: 4 bytes of RAM less.
  alignas(uint32_t) uint8_t _filled = 0;
  uint8_t _gapAt = Nowhere;
  bool _gapCertain = false;
  uint8_t _places[Capacity + Pad + Capacity];
  uint8_t *_incoming = _places + Capacity + Pad;
  uint8_t *_newest = _places;
};

}  // namespace sbus
