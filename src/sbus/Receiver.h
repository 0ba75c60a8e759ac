// Finds the frames in a stream of bytes. It neither decodes them (Frame.h) nor knows where the bytes come from.
#pragma once

#include <stdint.h>

#include "Counters.h"
#include "Frame.h"
#include "Pauses.h"

namespace sbus {

// Two buffers: one holds the last complete frame, the other the frame that is coming in. Their roles are swapped when
// a frame is complete; no frame is ever copied. Bytes are read straight into the incoming frame, those that wait now
// and no more (DecodeSBus.cpp does it without asking twice):
//
//   for (waiting = available(); waiting > 0;) {
//     count = read(receiver.space(), min(waiting, receiver.room()));
//     waiting -= count;
//     receiver.received(count, waiting, now);
//   }
//
// Call it at least every 5 ms (see DecodeSBus.h). One call costs time in proportion to `count`, whatever the bytes are.
//
// There is no checksum, and 0F is a frequent payload byte: neutral FrSky sticks send it twice a frame. So a frame is
// delivered only if nothing speaks against it:
//   - header, end byte and the flags' unused bits are right;
//   - it begins where a frame has to: behind the last frame or behind a pause, or, when a character was lost or
//     inserted, near the place where the next header is due. Without any such clue a header must follow it;
//   - no pause lies within it, and looks at the port do not begin with another header more often than with its own;
//   - no further character belongs to it, and it does not look like a frame that has lost or gained one. If that
//     cannot be known yet the frame waits, until the next frame's header at the most.
//
// What is refused is scanned again from its second byte on: a true header may stand in it.
//
// All calls come from the context that reads the port. Only frame() and what stands below it may also be called from
// one that received() interrupts (see DecodeSBus.h).
class Receiver {
 public:
  // As reset() at the time 0, for 100000 baud.
  Receiver() { reset(0, CharacterTime); }
  Receiver(const Receiver &) = delete;             // its pointers lead into itself
  Receiver &operator=(const Receiver &) = delete;  // for the same reason

  // Forgets everything, the counters too. `now` in us, `characterTime` in us: 120 at 100000 baud, 60 at 200000.
  void reset(uint32_t now, uint8_t characterTime);

  // Where the next bytes go: room() of them. Other bytes go elsewhere after each received() and broken().
  uint8_t *space() { return _incoming + _filled; }

  // How many bytes fit there: 1..29.
  int room() const { return Capacity - _filled; }

  // `count` bytes, 0..room(), were written to space() at `now` (us, wraps), and `waiting` more (0..255) are read next.
  // All with the same `now` is one look at the port. Returns the frame that they completed (25 bytes), or nullptr. A
  // call without bytes lets a frame that waits for what follows know that nothing does.
  const uint8_t *received(int count, int waiting, uint32_t now);

  // The port lost bytes behind the last one received: what has come of the incoming frame will never be completed.
  // Counts as an overflow.
  void broken();

  // The last complete frame, 25 bytes; nullptr before the first. It may be overwritten as soon as the second frame
  // after it comes in: what was read of it is good only if counters().frames has not changed meanwhile.
  const uint8_t *frame() const { return _hasFrame ? _complete : nullptr; }

  // frame() where it is known that there is one; before the first, of no meaning.
  const uint8_t *newest() const { return _complete; }

  // When the last frame was completed, in us; before the first, of no meaning. Read this before the clock: then no age
  // is below zero if a frame comes in between.
  uint32_t frameTime() const { return _frameTime; }

  // What was seen since reset(); all 0 before the first byte.
  const Counters &counters() const { return _counters; }

 private:
  // A frame and the character behind it, and some more: so a line of headers without end costs fewer looks at the port.
  static constexpr uint8_t Capacity = FrameSize + 4;
  static constexpr uint8_t Pad = 3;  // in front of a frame: its payload then stands at a multiple of four
  static constexpr uint8_t Nowhere = 0xFF;

  // What is known of the place where the incoming frame begins.
  enum class Place : uint8_t {
    Any,      // nothing: it is a 0F
    NearDue,  // a header was due within some characters
    BehindPause,
    BehindFrame,
  };
  enum class Verdict : uint8_t { Deliver, Wait, Refuse };

  bool endsLikeAFrame(const uint8_t *frame);
  Verdict judge();
  bool likeTheLast() const;
  const uint8_t *search(int waiting, uint32_t quiet);
  void weigh();
  bool pauseSpeaksAgainst();
  bool mayBeShifted(bool nextKnown) const;
  const uint8_t *deliver();
  void align(int from);
  bool pauseInside() const { return _pauseAt - 1u < FrameSize - 1u; }  // Nowhere is none
  bool headerAt(int index) const { return _incoming[index] == HeaderByte; }

  // The small ones first: a Cortex-M0+ reaches bytes without further ado up to offset 31 only.
  uint8_t *_incoming = _frames[1] + Pad;
  uint8_t *_complete = _frames[0] + Pad;
  Pauses _pauses;
  uint8_t _filled;     // bytes in _incoming
  uint8_t _pauseAt;    // index of the first byte behind the newest pause, or Nowhere
  uint8_t _waiting;    // bytes that wait to be read
  uint8_t _lookAt;     // index of the first byte that the newest look has found
  int8_t _due;         // index at which the next header is due; may be passed already
  uint8_t _misses;     // headers that were due and did not come, or Lost: then none is due
  uint8_t _shortened;  // characters of a frame that has lost one, with all that belongs to it
  Place _place;
  bool _aligned;      // a header stands at the beginning of _incoming, and _place speaks of it
  uint8_t _disputed;  // number, modulo 256, of a frame that has a pause within it, and a header behind that
  bool _hasFrame;
  uint8_t _rivalAt;    // where the last look within a frame began that began with a header
  uint32_t _distrust;  // frames delivered, less the trust that they begin where they are found; see weigh()
  uint32_t _frameTime = 0;
  Counters _counters;
  alignas(4) uint8_t _frames[2][Pad + Capacity];
};

}  // namespace sbus
