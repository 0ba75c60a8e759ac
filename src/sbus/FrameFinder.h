/// @file
/// Finds the frames in a stream of bytes. Frame.h decodes them.
#pragma once

#include <stdint.h>

#include "Acquisition.h"
#include "Counters.h"
#include "Frame.h"
#include "FrameBuffer.h"
#include "FrameRules.h"
#include "LineTiming.h"

namespace sbus {

/// The events of a FrameFinder, in the order of the line's bytes. NoEvents ignores them at no cost; another class with
/// these functions can take its place. Places are counted from the first byte that taken(), discarded() and extra()
/// have not reported yet.
struct NoEvents {
  void begin() {}                          ///< reset() was called: all is forgotten
  void interval(uint32_t) {}               ///< the next frame came this many us after the previous one; see Counters
  void taken(const uint8_t *) {}           ///< the next bytes are this frame
  /// The next 25 bytes are this frame with header 2F, which was not yet complete at this time, us.
  void extra(const uint8_t *, uint32_t) {}
  void discarded(const uint8_t *, int) {}  ///< the next bytes, with their number, belong to no frame
  void lost() {}                           ///< bytes are missing before the next one
  void rejected(int, Rejection) {}         ///< the header at this place begins no frame
  /// Returns true if the polls reveal each gap. If they reveal only some, the characters between two gaps prove
  /// nothing.
  static constexpr bool seesEachGap() { return true; }
  /// Returns true if a DecodeSBus calls asked() in each poll.
  static constexpr bool wantsTimes() { return false; }
  void asked(int, uint32_t) {}  ///< by this time, us, this number of bytes had come and waits on the port
  void forgetAll() {}           ///< the board has slept: what the events before have brought is old
};

/// Finds frames. The bytes are read directly into the incoming frame:
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
/// Poll at least every 5 ms, and call idle() when nothing waits: only these polls reveal the gaps (LineTiming.h). The
/// time of a poll is proportional to the bytes found.
///
/// A frame has no checksum, and its payload may contain 0F. So 25 characters are accepted only if
/// - header, end byte and the unused bits of the flags are right;
/// - no gap lies inside them;
/// - they are aligned: they follow a frame or a gap, or a gap follows them. Otherwise they must not look like the end
///   of one frame and the start of the next;
/// - they end there: a gap or a header follows, or frames of this line end in this way.
///
/// After a rejection the search goes on from the second character. FrameRules.h has the rules, and
/// extras/docs/receiver.md says what each is worth.
///
/// `Format` is Frame16, Frame16Extra with 2F frames between, or Frame24 with 36 bytes. `Events` learns what becomes of
/// each byte.
///
/// Call all methods from the context that reads the port. Only frame() and the methods below it may also be called from
/// a context that received() interrupts (extras/docs/interrupts.md).
template <typename Format, typename Events = NoEvents>
class FrameFinderOf : private Events {
 public:
  /// Starts like reset() at the time 0, for 100000 baud.
  FrameFinderOf() { reset(0, CharacterTime, MostIdleCharacters); }

  /// Forgets everything, including the counters. `now` in us; `characterTime` in us: 120 at 100000 baud, 60 at 200000.
  /// `idleCharacters`: how long the port waits for more bytes before it hands over less than a burst.
  void reset(uint32_t now, uint8_t characterTime, uint8_t idleCharacters = MostIdleCharacters);

  /// Returns where to write the next room() bytes. It changes with each received() and broken().
  uint8_t *space() { return _buffer.space(); }

  /// Returns how many bytes fit there, 1 or more.
  int room() const { return _buffer.room(); }

  /// Takes a poll of the port at `now` (us, wraps) that found `found` bytes, 1 or more. Read them next.
  void poll(unsigned found, uint32_t now);

  /// Likewise, for a port that tells when the line was idle. `isPrompt`: the port has just handed the bytes over and
  /// called back. `isIdle`: the line was idle after them; call ended() once they are read. Returns how many bytes to
  /// read before likelyGap(), or 0.
  int pollIdling(unsigned found, uint32_t now, bool isPrompt, bool isIdle);

  /// The line may have been silent after the last byte.
  void likelyGap() { _buffer.markGap(Silence::Likely); }

  /// Takes a poll at `now` that found nothing. Returns the frame that waited for a silence to prove it, or nullptr.
  const uint8_t *idle(uint32_t now) {
    _timing.empty(now);
    return _buffer.filled() < Format::Size ? nullptr : settle(_timing.template silenceAfter<Format>());
  }

  /// The line was idle for a character or more after the last byte. Returns the frame that this proves, or nullptr.
  const uint8_t *ended() { return settle(Silence::Gap); }

  /// Returns true if the `waiting` bytes need not be read yet: they complete no frame, and no silence shows before them.
  /// The port has just called back, because half of its ring was full.
  bool mayWait(unsigned waiting, uint32_t now) {
    if (static_cast<unsigned>(_buffer.filled()) + waiting >= Format::Size ||
        !(isDue() ? isInTime(now) : silenceBefore(waiting, now) <= _timing.shortestGap())) {
      return false;
    }
    _unread = static_cast<uint8_t>(waiting);
    _timing.incomplete(now);
    return true;
  }

  /// Takes `count` bytes, 1..room(), that were written to space(); `waiting` more bytes of this poll are not read yet.
  /// Returns the frame (25 bytes) that they completed, or nullptr.
  const uint8_t *received(int count, int waiting) {
    _buffer.received(count);
    return _buffer.filled() < Format::Size && _buffer.isHeader(0) ? nullptr : search(waiting);
  }

  /// Drops the incoming frame, because the port has lost bytes after the last one received. Counts an overflow.
  void broken();

  /// Returns the receiver of the events.
  Events &events() { return *this; }
  const Events &events() const { return *this; }  ///< the receiver of the events

  /// Returns the last complete frame, 25 bytes; nullptr before the first. The second frame after it may overwrite it:
  /// use the bytes you read only if counters().frames has not changed meanwhile.
  const uint8_t *frame() const { return _counters.frames != 0 ? newest() : nullptr; }

  /// Returns frame() without testing for the first one; undefined before the first frame.
  const uint8_t *newest() const { return _buffer.newest(); }

  /// Returns a time, in us, shortly before the end of the last frame: an age counted from it is never too small, and at
  /// most some characters and a poll too large. Undefined before the first frame. Read it before the clock, so that no
  /// age is negative.
  uint32_t frameTime() const { return _frameTime; }

  /// Returns the time of the poll before the newest poll(), us: the bytes that the newest poll found had not come then.
  uint32_t pollBefore() const { return _timing.pollBefore(); }

  /// Returns true if no byte is left that may begin a frame.
  bool isEmpty() const { return _buffer.filled() == 0; }

  /// Returns the counters since reset(); all are 0 before the first byte.
  const Counters &counters() const { return _counters; }

 private:
  static constexpr int Size = Format::Size, FlagsAt = Size - 2, EndAt = Size - 1;

  void startOver(int offBy);
  void startPoll(unsigned found);
  void gapBefore(Silence gap);
  uint32_t silenceBefore(unsigned found, uint32_t handedOver) const {
    return _timing.silence(found - _unread, handedOver, _unread != 0 ? _timing.lastPoll() : _timing.lastBytes());
  }
  int likelyGapAt(uint32_t silence, bool isWhole);
  bool isDue() const { return _aligned && _expectedAt == 0; }
  bool isInTime(uint32_t now) const { return now - _takenBy < _counters.period + LineTiming::LongestStop; }
  void checkFound();
  void lost(uint32_t &counter);
  const uint8_t *settle(Silence gap);
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
  static uint8_t variantOf(uint8_t end) {
    const uint8_t variant = variantOfEnd(end);
    return Format::Variants == UnknownVariant || variant < Format::Variants ? variant : UnknownVariant;
  }

  // The small ones first: a Cortex-M0+ reaches bytes in one instruction up to offset 31 only.
  uint8_t _variant;    // of the line: a row of LineVariants, or UnknownVariant
  bool _aligned;       // the last frame was aligned
  int8_t _expectedAt;  // index where the next frame is expected; below 0: that many characters ago
  uint8_t _rejected;   // headers rejected in this poll
  uint8_t _unread;     // bytes that waited at the newest poll, and were not read; 0: none
  uint16_t _found;     // bytes that this poll has found
  bool _owed;          // the port has lost bytes after those of this poll
  bool _hasBreaks;     // a break has come on this line, and no frame of another variant since
  Acquisition<Format> _acquisition;
  LineTiming _timing;
  FrameBuffer<Format> _buffer;
  uint32_t _completeAfter;  // us: the frame at the buffer's beginning was not complete then
  uint32_t _frameTime = 0;
  uint32_t _takenBy;  // us: time of the poll that brought the last frame
  Counters _counters;
};

template <typename Format, typename Events>
SBUS_IN_LINE void FrameFinderOf<Format, Events>::startPoll(unsigned found) {
  _rejected = 0;
  _found = static_cast<uint16_t>(found);
}

// Inlined like received(): most polls then cost some 100 cycles a frame less.
template <typename Format, typename Events>
SBUS_IN_LINE void FrameFinderOf<Format, Events>::poll(unsigned found, uint32_t now) {
  startPoll(found);
  if (LineTiming::ClockRuns && _owed) {
    lost(_counters.shortfalls);
  }
  const Silence silence = _timing.silenceBefore<Format>(found, now);
  if (silence == Silence::Long) {
    startOver(rules::FirstOffBy);
  } else if (silence >= Silence::Gap) {
    gapBefore(silence);
  } else if (silence == Silence::Likely) {
    _buffer.markGap(silence);
  }
  if (_timing.mayFallShort()) {
    checkFound();
  }
  _acquisition.characters(found);
}

// The port tells when the line was idle, but not where half of its ring ends. There only the time can show a gap, and
// other work may have delayed the call. So such a gap is certain only after a frame's number of characters, and is not
// looked for between two idle times where a frame is due in time: parts of two frames are a frame period apart.
template <typename Format, typename Events>
SBUS_IN_LINE int FrameFinderOf<Format, Events>::pollIdling(unsigned found, uint32_t now, bool isPrompt, bool isIdle) {
  startPoll(found);
  const int all = _buffer.filled() + static_cast<int>(found);
  const bool isWhole = all == Format::Size && isIdle;
  int before = 0;
  if (!isDue() || (!isWhole && all >= Format::Size) || !isInTime(now)) {
    before = likelyGapAt(silenceBefore(found, isPrompt ? now : _timing.lastPoll()), isWhole);
  }
  _timing.take(now);
  _unread = 0;
  _acquisition.characters(found);
  return before;
}

/// Finds frames of 16 channels, which nearly all receivers send.
using FrameFinder = FrameFinderOf<Frame16>;

}  // namespace sbus
