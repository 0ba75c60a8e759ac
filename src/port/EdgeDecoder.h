/// @file
/// Makes the characters of an S.Bus line from the times between its edges.
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "../sbus/Text.h"

namespace sbus {

// What is noted for an edge, one byte: from 3 on, the ticks of 0.5 us since the edge before. (An edge that is noted
// comes 3 ticks or more after the one before: the capture unit is not switched earlier.)
namespace edge {
constexpr uint8_t Missed = 0;    // edges were missed before this one
constexpr uint8_t LongFall = 1;  // the line has been high for 256 ticks or more
constexpr uint8_t LongRise = 2;  // the line has been low for as long
}  // namespace edge

// Characters of 8E2 at 100000 baud. The level changes with each edge, so an edge is nothing but a time: each is placed
// by its distance from the start bit's edge, and must stand within 4 us of a bit's boundary. What would be a
// wrong character is none: a pulse of 3 to 7 us, an edge between two bits, a wrong parity or stop bit, a missed edge. A
// shorter pulse cancels out.
//
// After such a fault nothing counts until the line has idled for a character: a frame that lacks a character is lost
// anyway. After missed edges, or if nobody reads the characters in time, those that wait are dropped, and the next
// read() fails: so the reader knows of the loss, and does not join frames on both sides.
class EdgeDecoder {
 public:
  static constexpr uint8_t Room = 64;      // characters
  static constexpr uint8_t ApartMin = 12;  // ticks: no two edges of a character are nearer
  static constexpr uint8_t None = 1;       // mask of an edge between two bits, or after the end

  // Returns, for each tick, which data bits an edge at this time changes: the one that begins there, and all after it;
  // from 4 us before each boundary on.
  static const uint8_t *masks() {
#define SBUS_FIVE(mask) mask, mask, mask, mask, mask
#define SBUS_BOUNDARY(mask) None, None, SBUS_FIVE(mask), SBUS_FIVE(mask), SBUS_FIVE(mask), mask, mask, mask
    static const uint8_t Masks[256] SBUS_FLASH = {SBUS_FIVE(None),     SBUS_FIVE(None),
                                                  SBUS_BOUNDARY(0xFF), SBUS_BOUNDARY(0xFE),
                                                  SBUS_BOUNDARY(0xFC), SBUS_BOUNDARY(0xF8),
                                                  SBUS_BOUNDARY(0xF0), SBUS_BOUNDARY(0xE0),
                                                  SBUS_BOUNDARY(0xC0), SBUS_BOUNDARY(0x80),
                                                  SBUS_BOUNDARY(0),    SBUS_BOUNDARY(0),
                                                  SBUS_FIVE(None),     SBUS_FIVE(None),
                                                  SBUS_FIVE(None),     SBUS_FIVE(None),
                                                  SBUS_FIVE(None),     SBUS_FIVE(None),
                                                  SBUS_FIVE(None),     SBUS_FIVE(None),
                                                  SBUS_FIVE(None),     None};
#undef SBUS_BOUNDARY
#undef SBUS_FIVE
    return Masks;
  }

  // Forgets everything, and waits for an idle line: low, or if not `inverted` high.
  void begin(bool inverted) {
    _start = inverted ? edge::LongRise : edge::LongFall;
    _count = 0;
    fail();
  }

  // Takes edges of a ring of 256 from `from` on: up to `to`, or the ring's end, or one that is no boundary of a bit.
  // Returns the place of the next one. `from` is not `to`. Plain::take() takes what most of them are, as PlainEdges
  // does.
  template <typename Plain>
  uint8_t take(const uint8_t *ring, uint8_t from, uint8_t to) {
    const uint8_t end = from < to ? to : 0;
    const uint8_t left = takeBits<Plain>(ring + from, static_cast<uint8_t>(end - from));
    uint8_t next = static_cast<uint8_t>(end - left);
    if (left != 0) {
      step(ring[next++]);
    }
    return next;
  }

  // Returns true if a character has begun that idle() may complete.
  __attribute__((always_inline)) bool isOpen() const { return _time != Closed || _carried != 0; }

  // No edge has come since the newest that was taken, `ticks` ago: completes a character whose last bits are like an
  // idle line.
  void idle(uint16_t ticks) {
    if (isOpen() && (ticks > End || ticks + kept() + _carried > End)) {
      finish();
    }
  }

  // Drops what waits: edges were lost after it.
  void lose() {
    _count = Lost;
    fail();
  }

  // Returns how many characters wait. If some were lost before them, returns 1: the first read() then tells that.
  uint8_t available() const { return (_count & Lost) != 0 ? 1 : _count; }
  // Returns true if read() returns a character.
  bool isReady() const { return static_cast<int8_t>(_count) > 0; }
  // Returns the oldest character; undefined if !isReady().
  uint8_t peek() const { return _characters[_first]; }
  // Returns and removes the oldest character. Returns -1 without one, and once if characters were lost before it.
  int read() {
    if (!isReady()) {
      _count = static_cast<uint8_t>(_count & ~Lost);
      return -1;
    }
    const uint8_t character = peek();
    _first = static_cast<uint8_t>(_first + 1) % Room;
    _count--;
    return character;
  }

 private:
  static constexpr uint8_t Bit = 20;                     // ticks
  static constexpr uint8_t End = 10 * Bit + Bit / 2;     // from the start of a character to the middle of its stop bit
  static constexpr uint8_t LastBit = 9 * Bit + Bit / 2;  // a later edge is the first stop bit's
  static constexpr uint8_t Glitch = 6;                   // ticks: a shorter pulse cancels out
  static constexpr uint8_t Closed = 255;                 // time: no character has begun, or see _carried
  static constexpr uint8_t High = 0xFF;                  // level: like a start bit
  static constexpr uint8_t Lost = 0x80;                  // in _count
  static_assert(Lost % Room == 0 && (Room & (Room - 1)) == 0, "keep() counts on it");

  // Takes edges that are boundaries of bits, up to the first that is more. Returns how many are left. (It calls
  // nothing: then a compiler saves no registers.)
  template <typename Plain>
  __attribute__((noinline)) uint8_t takeBits(const uint8_t *edges, uint8_t count) {
    uint8_t before = _before, time = _time, bits = _bits, level = _level;
    while (count != 0) {
      Plain::take(edges, count, before, time, bits, level);
      if (count == 0 || *edges < ApartMin || time == Closed || level == High ||
          static_cast<uint8_t>(End - time) >= *edges) {
        break;
      }
      keep(bits, time > LastBit);  // the next start bit
      time = 0;
      bits = 0;
      level = High;
      edges++;
      count--;
    }
    _before = before;
    _time = time;
    _bits = bits;
    _level = level;
    return count;
  }

  // The time of the newest edge that counts.
  uint8_t kept() const { return _carried != 0 ? _before : _time; }

  // Takes an edge that is more than the boundary of a data bit.
  __attribute__((noinline)) void step(uint8_t ticks) {
    if (ticks >= ApartMin && _time != Closed) {
      fail();  // between two bits, or high for longer than a character
    } else if (ticks == edge::Missed) {
      lose();
    } else if (ticks == edge::LongFall || ticks == edge::LongRise) {
      if (isOpen()) {
        finish();
      }
      if (ticks == _start) {
        open();
      } else {
        fail();
      }
    } else if (_carried != 0) {
      resume(ticks);
    } else if (!isOpen()) {
      if (!_isBroken) {
        open();
      }
    } else if (ticks < Glitch) {
      cancel(ticks);
    } else {
      fail();
    }
  }

  // Takes the edge after two that have cancelled each other out.
  void resume(uint8_t ticks) {
    const unsigned since = unsigned{_carried} + ticks;
    if (_before + since > End) {
      finish();
      if (!_isBroken) {
        open();
      }
      return;
    }
    _time = _before;
    _carried = 0;
    const uint8_t now = static_cast<uint8_t>(_before + since);
    const uint8_t mask = SBUS_IN_FLASH(masks() + now);
    if (mask == None) {
      fail();
    } else {
      _time = now;
      flip(mask);
    }
  }

  void flip(uint8_t mask) {
    _bits = static_cast<uint8_t>(_bits ^ mask);
    _level = static_cast<uint8_t>(~_level);
  }

  void open() {
    _isBroken = false;
    _carried = 0;
    _time = 0;
    _bits = 0;
    _level = High;
  }

  // The edge before, and one that comes `ticks` later, cancel each other out.
  void cancel(uint8_t ticks) {
    if (_time != 0) {
      flip(SBUS_IN_FLASH(masks() + _time));
      _carried = static_cast<uint8_t>(_time - _before + ticks);
    }
    _time = Closed;
  }

  void fail() {
    _isBroken = true;
    _carried = 0;
    _time = Closed;
  }

  // The character ends: keeps it if its stop bit is right.
  void finish() {
    if (_level == High) {
      fail();
      return;
    }
    keep(_bits, kept() > LastBit);
    _carried = 0;
    _time = Closed;
  }

  // Keeps a character if its parity is right. If an edge came with the stop bit, the parity bit was 0.
  __attribute__((always_inline)) void keep(uint8_t bits, bool isZero) {
    uint8_t odd = static_cast<uint8_t>(bits ^ bits >> 4);
    odd = static_cast<uint8_t>(odd ^ odd >> 2);
    odd = static_cast<uint8_t>(odd ^ odd >> 1);
    if (isZero) {
      odd = static_cast<uint8_t>(~odd);
    }
    if ((odd & 1) != 0) {
      uint8_t count = _count;
      if ((count & Room) != 0) {
        count = Lost;
      }
      _characters[static_cast<uint8_t>(_first + count) % Room] = bits;
      _count = static_cast<uint8_t>(count + 1);
    }
  }

  uint8_t _start;              // the code of a start bit's edge after an idle line
  bool _isBroken;              // waits for an idle line
  uint8_t _before = 0, _time;  // of the newest two edges that count, ticks from the character's start
  uint8_t _carried;            // ticks from the edge at _before to one that has cancelled the one at _time; mostly 0
  uint8_t _bits = 0;           // the data, from the edges so far
  uint8_t _level = 0;          // after the newest edge
  uint8_t _first = 0, _count;  // of those that wait; Lost: some were lost before them, as read() has not yet told
  uint8_t _characters[Room];
};

// Edges that are each a boundary of a data bit.
struct PlainEdges {
  // Takes up to `count` edges, 1 or more, until one is none or more; changes what EdgeDecoder knows.
  static void take(const uint8_t *&edges, uint8_t &count, uint8_t &before, uint8_t &time, uint8_t &bits,
                   uint8_t &level) {
    for (; count != 0; count--) {
      const unsigned now = unsigned{time} + *edges;
      const uint8_t mask = now < 256 ? SBUS_IN_FLASH(EdgeDecoder::masks() + now) : EdgeDecoder::None;
      if (*edges < EdgeDecoder::ApartMin || mask == EdgeDecoder::None) {
        return;
      }
      edges++;
      before = time;
      time = static_cast<uint8_t>(now);
      bits = static_cast<uint8_t>(bits ^ mask);
      level = static_cast<uint8_t>(~level);
    }
  }
};

}  // namespace sbus
