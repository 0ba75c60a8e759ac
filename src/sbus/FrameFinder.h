/// @file
/// Finds the frames in a stream of bytes. It neither decodes them (Frame.h) nor knows where the bytes come from.
#pragma once

#include <stdint.h>

#include "Counters.h"
#include "Frame.h"
#include "Pauses.h"

namespace sbus {

/// Two buffers: one holds the last complete frame, the other the frame that is coming in. They swap roles when a frame
/// is complete; no frame is ever copied. Bytes are read straight into the incoming frame:
///
///     int waiting = available();
///     finder.poll(waiting, now);
///     while (waiting > 0) {
///       const int count = read(finder.space(), min(waiting, finder.room()));
///       waiting -= count;
///       finder.received(count);
///     }
///
/// Poll every 5 ms. A poll costs time in proportion to the bytes found, whatever they are.
///
/// A frame has no checksum, and its payload may hold 0F. So 25 characters are a frame only if
/// - header, end byte and the flags' unused bits are right;
/// - no pause lies within them;
/// - it is certain where a frame begins: after a frame, after a pause, or before one. Where it is not, they must not
///   look like the halves of two frames;
/// - it is certain that they end there: a pause or a header follows, or frames of this line are known to end so.
///
/// What is refused is scanned again from its second byte on. extras/docs/receiver.md has each rule, and what it is
/// worth.
///
/// `Format` is Frame16 or Frame24; what is said of 25 bytes goes for 36 then.
///
/// All calls come from the context that reads the port. Only frame() and what stands below it may also be called from
/// one that received() interrupts (extras/docs/interrupts.md).
template <typename Format>
class FrameFinderOf {
 public:
  /// As reset() at the time 0, for 100000 baud.
  FrameFinderOf() { reset(0, CharacterTime); }
  FrameFinderOf(const FrameFinderOf &) = delete;             ///< its pointers lead into itself
  FrameFinderOf &operator=(const FrameFinderOf &) = delete;  ///< for the same reason

  /// Forgets everything, the counters too. `now` in us, `characterTime` in us: 120 at 100000 baud, 60 at 200000.
  void reset(uint32_t now, uint8_t characterTime);

  /// Where the next bytes go: room() of them. It changes with each received() and broken().
  uint8_t *space() { return _incoming + _filled; }

  /// How many bytes fit there: 1 or more.
  int room() const { return Capacity - _filled; }

  /// A poll of the port at `now` (us, wraps) has found so many bytes, 1 or more. They are read next.
  void poll(unsigned found, uint32_t now);

  /// `count` bytes, 1..room(), were written to space(). Returns the frame that they completed (25 bytes), or nullptr.
  const uint8_t *received(int count) {
    _filled = static_cast<uint8_t>(_filled + count);
    return _filled < Format::Size && isHeader(0) ? nullptr : search();
  }

  /// The port lost bytes after the last one received: the incoming frame will never be complete. Counts as an overflow.
  void broken();

  /// The last complete frame, 25 bytes; nullptr before the first. It may be overwritten as soon as the second frame
  /// after it comes in: what was read of it is good only if counters().frames has not changed meanwhile.
  const uint8_t *frame() const { return _counters.frames != 0 ? _complete : nullptr; }

  /// frame() where it is known that there is one; before the first, of no meaning.
  const uint8_t *newest() const { return _complete; }

  /// When the last frame was complete, in us; before the first, of no meaning. Read this before the clock: then no age
  /// is below zero if a frame comes in between.
  uint32_t frameTime() const { return _frameTime; }

  /// The last complete frame with header 2F, 25 bytes; of no meaning before the first, counters().extraFrames tells.
  /// What was read of it is good only if that has not changed meanwhile.
  const uint8_t *extra() const { return _extra; }

  /// Its age counts from here, in us: from the poll before the one that found what follows it. So it is never too
  /// young.
  uint32_t extraTime() const { return _extraTime; }

  /// What was seen since reset(); all 0 before the first byte.
  const Counters &counters() const { return _counters; }

 private:
  static constexpr int Pad = 3;  // before a frame: its payload then stands at a word
  // A frame, its tail, and enough to tell what follows; so many that the other frame's payload stands at a word, too.
  static constexpr int Capacity = (Pad + Format::Size + LongestTail + 10) / 4 * 4 - Pad;
  static constexpr uint8_t Nowhere = 0xFF;

  static constexpr int Size = Format::Size, FlagsAt = Size - 2, EndAt = Size - 1;

  // What judge() says; else how many characters further on a frame may begin.
  enum : int { Deliver = -1, Wait = 0 };

  void learn(unsigned found, uint32_t quiet);
  const uint8_t *search();
  bool isUsual() const;
  bool scan();
  bool find();
  bool takesExtra();
  int firstHeader(int from) const;
  uint8_t kindAt(int start);
  int judge(int start, uint8_t kind);
  bool wasBlocked(int start) const;
  const uint8_t *deliver();
  void skip(int count);
  void drop(int count);
  static uint8_t kindOf(uint8_t end) {
    const uint8_t kind = kindOfEnd(end);
    return Format::Kinds == UnknownKind || kind < Format::Kinds ? kind : UnknownKind;
  }
  bool isHeader(int index) const { return _incoming[index] == HeaderByte; }

  // The small ones first: a Cortex-M0+ reaches bytes in one instruction up to offset 31 only.
  Pauses _pauses;
  uint8_t _kind;        // of the line: a row of LineKinds, or UnknownKind
  bool _certain;        // the last frame began where a frame begins
  bool _pauseBefore;    // the last poll's first character came after a pause
  bool _idleAfter;      // while the kind is unknown: the line was idle after the last poll's characters
  uint8_t _filled;      // bytes in _incoming
  uint8_t _pauseAt;     // index of the first byte after the newest pause, or Nowhere
  uint8_t _refused;     // headers refused in this poll
  uint8_t _others;      // while the kind is unknown: above 0, frames of the other size have been seen
  bool _onlyNoise;      // since the last frame: neither a pause nor a header
  uint8_t _sincePause;  // while the kind is unknown: characters since a pause, or FarOff
  int8_t _skipped;      // characters since the next frame was expected; below 0: a tail comes first
  uint8_t *_incoming = _frames[1] + Pad;
  uint8_t *_complete = _frames[0] + Pad;
  uint32_t _quiet;  // us before the last poll
  uint32_t _frameTime = 0;
  Counters _counters;
  alignas(4) uint8_t _frames[2][Pad + Capacity];
  uint8_t _extra[Format::HasExtra ? FrameSize : 1];
  uint32_t _extraTime;
};

// Here, as received(): with no call most polls cost some 100 cycles a frame less.
template <typename Format>
inline void FrameFinderOf<Format>::poll(unsigned found, uint32_t now) {
  const uint32_t quiet = _pauses.quiet(now);
  if (quiet == 0) {
    return;  // it is still the same poll
  }
  _quiet = quiet;
  _refused = 0;
  _pauseBefore = _pauses.pauseBefore(found, quiet);
  if (_pauseBefore) {
    _pauseAt = _filled;
  }
  if (_kind == UnknownKind) {
    learn(found, quiet);
  }
}

/// Of 16 channels, as nearly all receivers send them.
using FrameFinder = FrameFinderOf<Frame16>;

}  // namespace sbus
