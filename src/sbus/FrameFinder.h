/// @file
/// Finds the frames in a stream of bytes. It neither decodes them (Frame.h) nor knows where the bytes come from.
#pragma once

#include <stdint.h>

#include "Acquisition.h"
#include "Counters.h"
#include "Frame.h"
#include "FrameBuffer.h"
#include "FrameRules.h"
#include "LineTiming.h"

namespace sbus {

/// What a FrameFinder tells of each byte of the line, in their order; this one hears nothing and costs nothing. A class
/// that takes its place has these functions. What they say of a place counts from the first byte that none of taken(),
/// discarded() and extra() has had yet.
struct NoEvents {
  void taken() {}                   ///< the next bytes are a frame
  void extra() {}                   ///< the next 25 bytes are a frame with header 2F
  void discarded(int) {}            ///< so many bytes belong to no frame
  void rejected(int, Rejection) {}  ///< at this place stands a header, and no frame begins with it
  /// Asks it whether polls tell each gap of the line. Where they tell some only, none says how long a frame is.
  static constexpr bool seesEachGap() { return true; }
};

/// Bytes are read straight into the incoming frame:
///
///     int waiting = available();
///     if (waiting <= 0) { finder.idle(now); return; }
///     finder.poll(waiting, now);
///     while (waiting > 0) {
///       const int count = read(finder.space(), min(waiting, finder.room()));
///       waiting -= count;
///       finder.received(count, waiting);
///     }
///
/// Poll every 5 ms, and say so if there is nothing: idle() is what tells the line's gaps (LineTiming.h). A poll costs
/// time in proportion to the bytes found, whatever they are.
///
/// A frame has no checksum, and its payload may hold 0F. So 25 characters are a frame only if
/// - header, end byte and the flags' unused bits are right;
/// - no gap lies within them;
/// - it is certain where a frame begins: after a frame, after a gap, or before one. Where it is not, they must not
///   look like the halves of two frames;
/// - it is certain that they end there: a gap or a header follows, or frames of this line are known to end so.
///
/// What is rejected is searched again from its second byte on. FrameRules.h has the rules, extras/docs/receiver.md what
/// each is worth.
///
/// `Format` is Frame16 or Frame24; what is said of 25 bytes goes for 36 then. `Events` hears what becomes of each byte.
///
/// All calls come from the context that reads the port. Only frame() and what stands below it may also be called from
/// one that received() interrupts (extras/docs/interrupts.md).
template <typename Format, typename Events = NoEvents>
class FrameFinderOf : private Events {
 public:
  /// As reset() at the time 0, for 100000 baud.
  FrameFinderOf() { reset(0, CharacterTime, MostIdleCharacters); }

  /// Forgets everything, the counters too. `now` in us, `characterTime` in us: 120 at 100000 baud, 60 at 200000.
  /// `idleCharacters`: so long the port waits for more before it hands over less than a full burst.
  void reset(uint32_t now, uint8_t characterTime, uint8_t idleCharacters = MostIdleCharacters);

  /// Where the next bytes go: room() of them. It changes with each received() and broken().
  uint8_t *space() { return _buffer.space(); }

  /// How many bytes fit there: 1 or more.
  int room() const { return _buffer.room(); }

  /// A poll of the port at `now` (us, wraps) has found so many bytes, 1 or more. They are read next.
  void poll(unsigned found, uint32_t now);

  /// A poll at `now` has found none. Returns the frame that had waited for the line to fall silent, or nullptr.
  const uint8_t *idle(uint32_t now) {
    _timing.empty(now);
    return _buffer.filled() < Format::Size ? nullptr : settle();
  }

  /// `count` bytes, 1..room(), were written to space(), and `waiting` of this poll's are still to be read. Returns the
  /// frame that they completed (25 bytes), or nullptr.
  const uint8_t *received(int count, int waiting) {
    _buffer.received(count);
    return _buffer.filled() < Format::Size && _buffer.isHeader(0) ? nullptr : search(waiting);
  }

  /// The port lost bytes after the last one received: the incoming frame will never be complete. Counts as an overflow.
  void broken();

  /// What hears the events.
  Events &events() { return *this; }
  const Events &events() const { return *this; }  ///< the same

  /// The last complete frame, 25 bytes; nullptr before the first. It may be overwritten as soon as the second frame
  /// after it comes in: what was read of it is good only if counters().frames has not changed meanwhile.
  const uint8_t *frame() const { return _counters.frames != 0 ? newest() : nullptr; }

  /// frame() where it is known that there is one; before the first, of no meaning.
  const uint8_t *newest() const { return _buffer.newest(); }

  /// The last frame's end came after this time, in us, and some characters and a poll later at most: so no age is too
  /// young. Before the first frame of no meaning. Read this before the clock: then no age is below zero if a frame comes
  /// in between.
  uint32_t frameTime() const { return _frameTime; }

  /// The last complete frame with header 2F, 25 bytes; of no meaning before the first, counters().extraFrames tells.
  /// What was read of it is good only if that has not changed meanwhile.
  const uint8_t *extra() const { return _extra; }

  /// frameTime() of extra().
  uint32_t extraTime() const { return _extraTime; }

  /// What was seen since reset(); all 0 before the first byte.
  const Counters &counters() const { return _counters; }

 private:
  static constexpr int Size = Format::Size, FlagsAt = Size - 2, EndAt = Size - 1;

  void startOver(int offBy);
  void gapBefore();
  const uint8_t *settle();
  const uint8_t *search(int waiting);
  bool scan(int waiting);
  bool find();
  void noteEnd(int waiting);
  void takeExtra(int waiting);
  int firstHeader(int from) const;
  uint8_t variantAt(int start);
  Verdict judge(int start, uint8_t variant);
  const uint8_t *deliver();
  void discard(int count);
  static uint8_t kindOf(uint8_t end) {
    const uint8_t variant = variantOfEnd(end);
    return Format::Kinds == UnknownVariant || variant < Format::Kinds ? variant : UnknownVariant;
  }

  // The small ones first: a Cortex-M0+ reaches bytes in one instruction up to offset 31 only.
  uint8_t _variant;       // of the line: a row of LineVariants, or UnknownVariant
  bool _certain;       // the last frame's place was certain
  int8_t _expectedAt;  // index where the next frame is expected; below 0: so many characters ago
  uint8_t _rejected;   // headers rejected in this poll
  uint16_t _found;     // bytes that this poll has found
  bool _onlyNoise;     // since the last frame: neither a gap nor a header
  Acquisition<Format> _acquisition;
  LineTiming _timing;
  FrameBuffer<Format> _buffer;
  uint32_t _completeAfter;  // us: the frame at the buffer's beginning was not complete then
  uint32_t _frameTime = 0;
  uint32_t _extraTime;
  Counters _counters;
  uint8_t _extra[Format::HasExtra ? FrameSize : 1];
};

// Here, as received(): with no call most polls cost some 100 cycles a frame less.
template <typename Format, typename Events>
SBUS_IN_LINE void FrameFinderOf<Format, Events>::poll(unsigned found, uint32_t now) {
  _rejected = 0;
  _found = static_cast<uint16_t>(found);
  const Silence silence = _timing.silenceBefore<Format>(found, now);
  if (silence == Silence::Long && holds(Rule::silence)) {
    startOver(rules::FirstOffBy);
  } else if (silence == Silence::Gap) {
    gapBefore();
  } else if (silence != Silence::Unknown) {
    _buffer.markGap(false);
  }
  _acquisition.characters(found);
}

/// Of 16 channels, as nearly all receivers send them.
using FrameFinder = FrameFinderOf<Frame16>;

}  // namespace sbus
