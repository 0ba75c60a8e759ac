/// @file
/// Finds the frames in a stream of bytes. Frame.h decodes them.
#pragma once

#include <stdint.h>

#include "FrameSizeCheck.h"
#include "Counters.h"
#include "Frame.h"
#include "FrameBuffer.h"
#include "FrameRules.h"
#include "JoinCheck.h"
#include "LineTiming.h"

namespace sbus {

/// The events of a FrameFinder, in the order of the line's bytes. NoEvents ignores them at no cost; another class with
/// these functions can take its place. Places are counted from the first byte that accepted(), discarded() and extra()
/// have not reported yet.
struct NoEvents {
  void begin() {}                    ///< reset() was called: all is forgotten
  void interval(uint32_t) {}         ///< the next frame came this many us after the previous one; see Counters
  void accepted(const uint8_t *) {}  ///< the next bytes are this frame
  /// The next 25 bytes are this frame with header 2F, which was not yet complete at this time, us.
  void extra(const uint8_t *, uint32_t) {}
  void discarded(const uint8_t *, int) {}  ///< the next bytes, with their number, belong to no frame
  void gap(int) {}                         ///< the line was silent after this many bytes that come in later events
  void lost() {}                           ///< bytes are missing before the next one
  void rejected(int, Rejection) {}         ///< the header at this place begins no frame
  /// Returns true if the polls reveal each gap. If they reveal only some, the characters between two gaps prove
  /// nothing.
  static constexpr bool seesEachGap() { return true; }
  /// Returns true if a DecodeSBus calls polled() in each poll.
  static constexpr bool wantsTimes() { return false; }
  void polled(int, uint32_t) {}  ///< by this time, us, this number of bytes had come and waits on the port
  void forgetAll() {}            ///< the board has slept: what the events before have brought is old
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
/// extras/docs/rules.md says what each is worth.
///
/// `Format` is Frame16, Frame16Extra with 2F frames between, or Frame24 with 36 bytes. `Events` learns what becomes of
/// each byte.
///
/// Call all methods from the context that reads the port. Only frame() and the methods below it may also be called from
/// a context that received() interrupts (extras/docs/interrupts.md).
template <typename Format, typename Events = NoEvents>
class FrameFinderOf : private Events, private JoinCheck<Format::Size, !LineTiming::ClockRuns && !Events::wantsTimes()> {
 public:
  /// Starts like reset() at the time 0, for 100000 baud.
  FrameFinderOf() { reset(0, CharacterTime, IdleCharactersMax); }

  /// Forgets everything, including the counters. `now` in us; `characterTime` in us: 120 at 100000 baud, 60 at 200000.
  /// `idleCharacters`: how long the port waits for more bytes before it hands over less than a burst.
  void reset(uint32_t now, uint8_t characterTime, uint8_t idleCharacters = IdleCharactersMax) {
    _timing.reset(now, characterTime, idleCharacters);
    _sizeCheck.reset();
    Join::reset();
    _variant = NoVariant;
    _aligned = false;
    _hasBreaks = false;
    _unread = 0;
    _buffer.clear();
    startOver(rules::FirstDistance);
    _counters = Counters();
    Events::begin();
  }

  /// The port tells what it has lost while interrupts were off, by bytesLost(). Call it after reset().
  void trustPort() { Join::trustPort(); }

  /// Returns where to write the next room() bytes. It changes with each received() and bytesLost().
  uint8_t *space() { return _buffer.space(); }

  /// Returns how many bytes fit there, 1 or more.
  int room() const { return _buffer.room(); }

  /// Takes a poll of the port at `now` (us, wraps) that found `found` bytes, 1 or more. Read them next.
  SBUS_IN_LINE void poll(unsigned found, uint32_t now) { poll(found, now, now); }

  /// Likewise; the port was asked at `asked`, and has answered by `now`. (Inlined like received(): most polls then cost
  /// some 100 cycles a frame less.)
  SBUS_IN_LINE void poll(unsigned found, uint32_t asked, uint32_t now) {
    startPoll(found);
    if (LineTiming::ClockRuns && _lossFollows) {
      lost(_counters.shortfalls);
    }
    const Silence silence = _timing.silenceBefore<Format>(found, asked, now);
    if (silence == Silence::Long) {
      startOver(rules::FirstDistance);
    } else if (isCertain(silence)) {
      gapBefore(silence);
    } else if (silence == Silence::Likely) {
      _buffer.markGap(Silence::Likely);
    }
    Join::poll(found, begins(), static_cast<uint16_t>(_timing.pollBefore()));
    const unsigned interval = _timing.interval();
    if (_timing.mayHaveFoundTooFew(interval)) {
      checkFound(interval);
    }
    _sizeCheck.characters(found);
  }

  /// Likewise, for a port that tells when the line was idle. `fromCallback`: the port has just handed the bytes over
  /// and called back. `isIdle`: the line was idle after them; call ended() once they are read.
  ///
  /// The port does not tell where half of its ring ends. There only the time can show a gap, and other work may have
  /// delayed the call. So such a gap is certain only after a frame's number of characters, and is not looked for
  /// between two idle times where a frame is due in time: parts of two frames are a frame period apart.
  SBUS_IN_LINE void pollIdling(unsigned found, uint32_t now, bool fromCallback, bool isIdle) {
    startPoll(found);
    const int all = _buffer.filled() + static_cast<int>(found);
    const bool isWhole = all == Size && isIdle;
    const bool isAfterIdle = _buffer.filled() != 0 && _buffer.gapAt() == _buffer.filled();  // is that gap wide?
    if (!isDue() || (!isWhole && all >= Size) || !isInTime(now) || isAfterIdle) {
      lookForGap(silenceBefore(found, fromCallback ? now : _timing.lastPoll()), isWhole);
    }
    _timing.notePoll(now);
    _unread = 0;
    _sizeCheck.characters(found);
  }

  /// Takes a poll at `now` that found nothing. Returns the frame that waited for a silence to prove it, or nullptr.
  const uint8_t *idle(uint32_t now) {
    _timing.empty(now);
    return _buffer.filled() < Format::Size ? nullptr : acceptAfterSilence(_timing.template silenceAfter<Format>());
  }

  /// The line was idle for a character or more after the last byte, or the next character was damaged. Returns the
  /// frame that this proves, or nullptr. (Nearly always the frame has been delivered: then a search is spared, 46
  /// cycles.)
  ///
  /// Before the first frame this is no proof, unless as many characters came between the two gaps before: a frame of 24
  /// channels with a damaged character has 25 characters, and then ten.
  const uint8_t *ended() {
    if (_buffer.filled() == 0) {
      gapBefore(Silence::Gap);
      return nullptr;
    }
    const bool isProof = _variant != NoVariant || _buffer.filled() < Size || _sizeCheck.isRepeated();
    return acceptAfterSilence(isProof ? Silence::Gap : Silence::Likely);
  }

  /// Returns true if the `waiting` bytes need not be read yet: they complete no frame, and no silence shows before
  /// them. The port has just called back, because half of its ring was full.
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
  void bytesLost() { lost(_counters.overflows); }

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
  // Not for a sensor, whose polls must be quick: on an AVR interrupts must not be off for 0.1 ms there.
  static constexpr bool ChecksJoins = !LineTiming::ClockRuns && !Events::wantsTimes();
  using Join = JoinCheck<Format::Size, ChecksJoins>;

  static constexpr int Size = Format::Size, FlagsAt = Size - 2, EndAt = Size - 1;
  static_assert(!Format::HasSlots || Size + rules::SlotsBehind <= FrameBuffer<Format>::Capacity,
                "else all wait for ever");
  static constexpr int JudgedWorth = 4;           // a header that judge() rejects costs as much as four without an end
  static constexpr int FarOff = FrameSize24 + 1;  // characters: the most that _expectedAt counts
  static constexpr uint32_t Unsteady = 2500;      // us: a frame is late by less, parts of two by 4 ms or more
  static constexpr uint32_t FrameMax = 5000;      // us, with some reserve for a period that is not steady
  static constexpr int32_t PeriodMin = 5376;      // us: an X8R has 6 ms; what is shorter comes from late polls

  // Counts rare events. Not inlined: 40 bytes less on an AVR, 8 on a Cortex-M0+.
  __attribute__((noinline)) static void countUp(uint32_t &counter) { counter++; }

  // Returns true if no frame is incomplete: the next byte begins one.
  bool begins() const { return _buffer.filled() == 0 || _buffer.gapAt() == _buffer.filled(); }

  // Returns true if the next byte is expected to begin a frame.
  SBUS_IN_LINE bool isDue() const { return _aligned && _expectedAt == 0; }
  // Returns true if a frame that is complete by this time, us, is late by less than `late`, us.
  bool isInTime(uint32_t by, uint32_t late = LineTiming::StopMax) const {
    return by - _lastBy < _counters.period + late;
  }

  // After lost bytes, or a silence longer than any frame period, the next character may stand anywhere in a frame.
  void startOver(int distance) {
    const int count = _buffer.filled();
    _counters.discardedBytes += static_cast<unsigned>(count);
    Events::discarded(_buffer.bytes(), count);
    Events::gap(0);
    _buffer.clear();
    _expectedAt = static_cast<int8_t>(-distance);
    _lossFollows = false;
    _sizeCheck.forget(distance == rules::FirstDistance);
  }

  SBUS_IN_LINE void startPoll(unsigned found) {
    _rejected = 0;
    _found = static_cast<uint16_t>(found);
  }

  // Takes a certain gap before the next character. A run of the other size forgets the variant: on a line of that size
  // two impaired frames may look like one of this size again and again.
  void gapBefore(Silence gap) {
    const int filled = _buffer.filled();
    Events::gap(filled);
    if (isWide(gap) && filled != 0 && filled < Size && _buffer.isHeader(0)) {
      uint8_t *const beginning = _buffer.bytes();
      countUp(_counters.rejectedByLength);
      Events::rejected(0, Rejection::GapInside);
      discard(filled);
      _buffer.restart(beginning);
    }
    _buffer.markGap(gap);
    if (!Events::seesEachGap()) {
      _sizeCheck.forget();
    }
    if (_sizeCheck.gap(filled, _variant == NoVariant)) {
      countUp(_counters.otherSizeFrames);
      _variant = NoVariant;
      _aligned = false;  // out of sync: isExactlyNext() needs a variant
    }
  }

  // Returns for how long the line seems to have been silent before the bytes that have come since the last call.
  uint32_t silenceBefore(unsigned found, uint32_t handedOver) const {
    return _timing.silence(found - _unread, handedOver, _unread != 0 ? _timing.lastPoll() : _timing.lastBytes());
  }

  // Takes a silence that the times show before the bytes that were not there at the last call.
  void lookForGap(uint32_t silence, bool isWhole) {
    const int filled = _buffer.filled();
    const bool mayStop = isWhole && (_buffer.gapAt() == 0 || isDue());
    const bool isLikely = silence > (mayStop ? LineTiming::StopMax : _timing.shortestGap());
    if (_unread == 0) {
      if (silence >= LineTiming::LongSilence) {
        startOver(rules::FirstDistance);
        return;
      }
      if (silence > _timing.shortestGap() && (_buffer.gapAt() == filled || _sizeCheck.isFrame() ||
                                              (filled == Size && (isDue() || _buffer.beginsWide())))) {
        gapBefore(silence > LineTiming::StopMax ? Silence::Wide : Silence::Gap);
        return;
      }
    }
    if (isLikely) {
      _buffer.markGap(Silence::Likely, static_cast<uint8_t>(filled + _unread));
    }
  }

  // While interrupts are off, a UART keeps a few characters and loses the others. If the line goes on at the same place
  // of a later frame, 25 characters of two frames stand there without a gap, and only the time shows that. A frame that
  // broke off may also have lost a character on the line: then there is an apparent gap. Otherwise the port has lost
  // bytes.
  void checkFound(unsigned interval) {
    const int missing = begins() ? 0 : Size - _buffer.filled();
    const bool isStretched = _sizeCheck.isStretched();
    if (ChecksJoins) {
      if (Join::late(interval, _found, static_cast<unsigned>(missing), _timing.characterTime(), isStretched)) {
        _buffer.markGap(Silence::Likely);
      }
    } else if (_timing.template foundTooFew<Format>(interval, _found, missing, _counters.period, isStretched)) {
      if (LineTiming::ClockRuns && static_cast<int>(_found) >= missing) {
        _lossFollows = static_cast<int32_t>(_counters.period) >= PeriodMin;
      } else {
        _buffer.markGap(isLate() ? Silence::Late : Silence::Likely);
      }
    }
  }

  // Returns true if characters that came too late to follow those before them may belong to the frame that is due,
  // whose sender then stretches it: those of the frame after it come later, as the period is longer than a frame and a
  // half.
  bool isLate() const {
    const uint32_t since = _timing.lastPoll() - _completeAfter;
    return LineTiming::ClockRuns && isDue() && static_cast<int32_t>(since + FrameMax - 2 * _counters.period) < 0;
  }

  // Drops the incoming frame, because the port has lost bytes after it.
  void lost(uint32_t &counter) {
    countUp(counter);
    startOver(FarOff);
    Events::lost();
  }

  // Takes a silence after the last byte. Returns the frame that waited for it, or nullptr.
  const uint8_t *acceptAfterSilence(Silence gap) {
    if (gap == Silence::Unknown || (_buffer.gapAt() == _buffer.filled() && _buffer.gap() >= gap)) {
      return nullptr;
    }
    gapBefore(gap);
    startPoll(0);
    return _buffer.filled() < Size ? nullptr : search(0);
  }

  const uint8_t *search(int waiting) {
    const bool wasAligned = ChecksJoins && _aligned;
    const bool isFrame =
        rules::isExactlyNext<Format>(_buffer.bytes(), _buffer.filled(), _buffer.gapAt(), _variant, isDue()) ||
        scan(waiting);
    noteEnd(waiting);
    if (!isFrame) {
      return nullptr;
    }
    const uint8_t *frame = nullptr;
    if (ChecksJoins && mayBeJoined(wasAligned && _expectedAt == 0)) {
      dropJoined();
    } else {
      frame = deliver();
    }
    _expectedAt = static_cast<int8_t>(LineVariants[_variant].tailSize);
    return frame;
  }

  // Returns true if the frame that is complete may consist of parts of several. (Not inlined: 102 bytes less on an
  // AVR.)
  __attribute__((noinline)) bool mayBeJoined(bool isInSync) {
    return (Join::isUnplaced() && _expectedAt != 0 && _expectedAt != -Size) ||
           Join::isJoined(static_cast<uint16_t>(_completeBy), _timing.characterTime(), _sizeCheck.isStretched(),
                          isInSync);
  }

  // Drops the frame that is complete. What follows it directly is in its place if this was a frame.
  void dropJoined() {
    uint8_t *const beginning = _buffer.bytes();
    countUp(_counters.shortfalls);
    Events::rejected(0, Rejection::NotAtGap);
    discard(Size);
    _buffer.moveTo(beginning);
    _aligned = false;
  }

  // Returns true if a frame is complete.
  bool scan(int waiting) {
    uint8_t *const beginning = _buffer.bytes();
    bool found = find();
    if (Format::HasExtra && found && _buffer[0] == ExtraHeader) {
      emitExtra(waiting);
      found = false;
    }
    _buffer.moveTo(beginning);
    return found;
  }

  // Returns true if a frame is complete. The buffer then begins with it, and otherwise with what may become a frame.
  bool find() {
    while (rules::hasSlots<Format>(_variant) && _expectedAt == 0) {
      // A sensor's answer: the next frame is expected after it, and after a gap where the answer lacks a character. So
      // it is after a break, if an answer or a gap follows.
      const uint8_t untilGap = isCertain(_buffer.gap()) ? _buffer.gapAt() : FrameBuffer<Format>::Nowhere;
      uint8_t size = SlotSize;
      if (rules::isBreak(_buffer[0])) {
        if (_buffer.filled() < 2) {
          return false;
        }
        if (!isSlotId(_buffer[1]) && untilGap != 1) {
          break;
        }
        _hasBreaks = true;
        size = 1;
      } else if (!isSlotId(_buffer[0])) {
        break;
      } else if (untilGap == 1 || untilGap == 2) {
        size = untilGap;
      }
      if (_buffer.filled() < size) {
        return false;
      }
      discard(size);
      _expectedAt = 0;
    }
    discard(firstHeader(0));
    int start = 0;
    bool found = false;
    for (const int last = _buffer.filled() - Size; start <= last;) {
      int step = 1, worth = 1;
      const uint8_t variant = variantAt(start);
      if (variant != NoVariant) {
        Verdict verdict = judge(start, variant);
        if (verdict.isAccepted() && rules::mayEndInBreak<Format>(variant, _hasBreaks)) {  // in judge(): 56 bytes more
          _hasBreaks = false;
          verdict = Verdict::reject(Rejection::NoEnd);
        }
        if (verdict.isAccepted()) {
          _variant = variant;
          _aligned = verdict.isAligned();
          found = true;
          break;
        }
        if (verdict.isOpen()) {
          break;
        }
        countUp(_counters.rejectedByLength);
        Events::rejected(start, verdict.why());
        step = verdict.skip();
        // A frame that only came late, and is held back whole, keeps its place: the next is due behind it.
        if (LineTiming::ClockRuns && step == Size && _buffer.gap() == Silence::Late && start == _expectedAt) {
          _expectedAt = static_cast<int8_t>(start + Size);
          _completeAfter = _timing.endedAfter(0);
        }
        worth = JudgedWorth;
      }
      // At most 24 headers of a poll are judged, as many as characters follow a frame's header.
      _rejected = static_cast<uint8_t>(_rejected + worth);
      start = _rejected < Size - 1 ? firstHeader(start + step) : _buffer.filled();
    }
    discard(start);
    return found;
  }

  // Notes when the frame that the buffer begins with was complete: once, in the poll that brought its end.
  void noteEnd(int waiting) {
    const int following = _buffer.filled() - Size;
    if (following >= 0 && following + waiting < static_cast<int>(_found)) {
      _completeAfter = _timing.endedAfter(static_cast<unsigned>(following + waiting));
      _completeBy = _timing.lastPoll();
    }
  }

  void emitExtra(int waiting) {
    noteEnd(waiting);
    countUp(_counters.extraFrames);
    if (!ChecksJoins || !mayBeJoined(true)) {
      Events::extra(_buffer.bytes(), _completeAfter);
    }
    _expectedAt = 0;
    _buffer.drop(FrameSize);
  }

  // Returns the index of the first header from `from` on, or filled().
  int firstHeader(int from) const {
    const int filled = _buffer.filled();
    while (from < filled && !_buffer.isHeader(from)) {
      from++;
    }
    return from;
  }

  // Returns the variant whose form the 25 bytes at `start` have, or NoVariant.
  uint8_t variantAt(int start) {
    const uint8_t variant = variantOf(_buffer[start + EndAt]);
    if (variant == NoVariant) {
      countUp(_counters.rejectedByEnd);
      Events::rejected(start, Rejection::NoEnd);
    } else if (!rules::areFlags(_buffer[start + FlagsAt]) ||
               rules::mayBeEnd<Format>(_buffer.bytes() + start, variant, _variant, _sizeCheck.betweenGaps())) {
      countUp(_counters.rejectedByFlags);
      Events::rejected(start, Rejection::Flags);
      return NoVariant;
    }
    return variant;
  }

  // Inlined: a call would make a line of headers cost a fifth more.
  SBUS_IN_LINE Verdict judge(int start, uint8_t variant) {
    const int_fast8_t distance = static_cast<int_fast8_t>(start - _expectedAt);
    const bool isFirst = start == 0;
    const bool isInSync = distance == 0 && _aligned;
    return rules::judge(
        Candidate<Format>{
            _buffer.bytes() + start, static_cast<int_fast8_t>(_buffer.filled() - start),
            static_cast<int_fast8_t>(_buffer.gapAt() - start), _buffer.gap(),
            isFirst ? _buffer.inside() : Silence::Unknown,
            isFirst && (isInSync && _counters.period != 0 ? isInTime(_completeBy, Unsteady) : _buffer.beginsWide()),
            variant, _variant, distance, isInSync},
        _sizeCheck);
  }

  // Inlined: 13 cycles a frame less.
  SBUS_IN_LINE const uint8_t *deliver() {
    const uint8_t *const frame = _buffer.complete();
    const uint32_t interval = _completeAfter - _frameTime;
    if (_counters.frames != 0) {
      if (_expectedAt < rules::NoiseMax - Size) {
        countUp(_counters.resyncs);
      }
      const bool hasMissed = _expectedAt < -rules::NoiseMax;  // then it is two periods or more
      _counters.measure(static_cast<uint32_t>(static_cast<int32_t>(interval) >> (hasMissed ? 1 : 0)));
    }
    _counters.count(Format::flags(frame));
    _frameTime = _completeAfter;
    _lastBy = _completeBy;
    Events::interval(interval);
    Events::accepted(frame);
    return frame;
  }

  // Discards the first characters of the incoming frame.
  void discard(int count) {
    if (_expectedAt > -FarOff) {
      _expectedAt = static_cast<int8_t>(_expectedAt - count);
    }
    _counters.discardedBytes += static_cast<unsigned>(count);
    Events::discarded(_buffer.bytes(), count);
    _buffer.drop(count);
  }

  static uint8_t variantOf(uint8_t end) {
    const uint8_t variant = variantOfEnd(end);
    return Format::Variants == VariantCount || variant < Format::Variants ? variant : NoVariant;
  }

  // The small ones first: a Cortex-M0+ reaches bytes in one instruction up to offset 31 only.
  uint8_t _variant;    // of the line: a row of LineVariants, or NoVariant
  bool _aligned;       // the last frame was aligned
  int8_t _expectedAt;  // index where the next frame is expected; below 0: that many characters ago
  uint8_t _rejected;   // headers rejected in this poll
  uint8_t _unread;     // bytes that waited at the newest poll, and were not read; 0: none
  uint16_t _found;     // bytes that this poll has found
  bool _lossFollows;   // bytes were lost after those that this poll found
  bool _hasBreaks;     // a break has come on this line, and no frame of another variant since
  FrameSizeCheck<Format> _sizeCheck;
  LineTiming _timing;
  FrameBuffer<Format> _buffer;
  uint32_t _completeAfter;  // us: the frame at the buffer's beginning was not complete then
  uint32_t _frameTime = 0;
  uint32_t _completeBy;  // us: time of the poll that brought its end
  uint32_t _lastBy;      // us: likewise, of the last frame
  Counters _counters;
};

/// Finds frames of 16 channels, which nearly all receivers send.
using FrameFinder = FrameFinderOf<Frame16>;

}  // namespace sbus
