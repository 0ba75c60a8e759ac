/// @file
/// Two alternating places for frames, so that no frame is copied.
#pragma once

#include <stdint.h>
#include <string.h>

#include "Frame.h"
#include "LineTiming.h"

namespace sbus {

/// Holds the incoming frame (the bytes that belong to no frame yet), the place of the newest gap in it, and the last
/// complete frame. Both payloads are aligned to a word, as Format::unpack() needs them.
template <typename Format>
class FrameBuffer {
  static constexpr int Pad = 3;  // bytes before a frame: they align its payload to a word

 public:
  static constexpr uint8_t Nowhere = 0xFF;  ///< gapAt() without a gap
  /// A frame, its tail, and the characters after it that are judged; rounded so that the other payload is aligned as
  /// well.
  static constexpr int Capacity = (Pad + Format::Size + TailMax + 10) / 4 * 4 - Pad;

  FrameBuffer() { clear(); }
  FrameBuffer(const FrameBuffer &) = delete;             ///< it has pointers into itself
  FrameBuffer &operator=(const FrameBuffer &) = delete;  ///< not copied

  uint8_t *space() { return _incoming + _filled; }                                   ///< where to write the next bytes
  int_fast8_t room() const { return static_cast<int_fast8_t>(Capacity - _filled); }  ///< how many fit there, 1 or more
  /// Takes `count` bytes that were written to space().
  void received(int count) { _filled = static_cast<uint8_t>(_filled + count); }

  int filled() const { return _filled; }                            ///< bytes of the incoming frame
  uint8_t *bytes() { return _incoming; }                            ///< the incoming frame, filled() bytes
  const uint8_t *bytes() const { return _incoming; }                ///< the incoming frame
  uint8_t operator[](int index) const { return _incoming[index]; }  ///< a byte of the incoming frame
  /// Returns true if there is a header at `index`.
  bool isHeader(int index) const { return isHeaderByte<Format>(_incoming[index]); }

  /// Returns the index of the first byte after the newest gap, 0..filled(), or Nowhere.
  uint8_t gapAt() const { return _gapAt; }
  Silence gap() const { return _gap; }  ///< how certain that gap is: Late, Likely, Gap or Wide
  /// Returns true if a wide gap comes before the incoming frame.
  bool beginsWide() const { return _gapAt == 0 ? isWide(_gap) : _beginsWide; }
  /// Returns how certain the gaps inside a frame at the beginning are, without the newest: Gap if all are certain,
  /// Late, Likely or Wide if one is that, Unknown if there are none.
  Silence inside() const { return _inside; }
  /// Marks a gap before the next byte.
  void markGap(Silence gap) { markGap(gap, _filled); }
  /// Marks a gap before the byte at `index`, which has not come yet.
  void markGap(Silence gap, uint8_t index) {
    if (_gapAt == index) {
      if (gap > _gap) {  // 4 bytes less than ?: on an AVR, 6 on a Cortex-M0+
        _gap = gap;
      }
      return;
    }
    if (_gapAt == 0) {
      _beginsWide = isWide(_gap);
    } else if (_gapAt < Format::Size && (_gap != Silence::Gap || _inside == Silence::Unknown)) {
      _inside = _gap;
    }
    _gapAt = index;
    _gap = gap;
  }

  /// Forgets the incoming frame.
  void clear() {
    _filled = 0;
    _gapAt = Nowhere;
    _gap = Silence::Unknown;
    forgetGaps();
  }

  /// Removes the first `count` bytes. The others stay where they are until moveTo().
  void drop(int count) {
    _incoming += count;
    forget(count);
  }

  /// Moves the incoming frame back to `beginning`, where bytes() was: once per search, not once per rejected header.
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

  /// Drops the incoming frame, which began at `beginning` before drop().
  void restart(uint8_t *beginning) { _incoming = beginning; }

  /// Completes the frame at the beginning of the buffer, and returns it. The bytes after it continue in the other
  /// place.
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

  /// Returns the last complete frame; undefined before the first.
  const uint8_t *newest() const { return _newest; }

 private:
  static constexpr int Spare = 2;  // these and the five members before them double as padding for the first place

  __attribute__((always_inline)) void forget(int count) {
    _filled = static_cast<uint8_t>(_filled - count);
    const uint8_t gapAt = static_cast<uint8_t>(_gapAt - count);
    _gapAt = gapAt > Capacity ? Nowhere : gapAt;  // below 0, or Nowhere less `count`: as bytes both are far above
    if (count != 0) {
      forgetGaps();
    }
  }
  // Only the newest gap is remembered, and what those before it say about a frame that begins with the first byte.
  void forgetGaps() {
    _beginsWide = false;
    _inside = Silence::Unknown;
  }

  alignas(uint32_t) uint8_t _filled;
  uint8_t _gapAt;
  Silence _gap, _inside;
  bool _beginsWide;
  uint8_t _places[Spare + Capacity + Pad + Capacity];
  uint8_t *_incoming = _places + Spare + Capacity + Pad;
  uint8_t *_newest = _places + Spare;
};

}  // namespace sbus
