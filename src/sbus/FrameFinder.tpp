// The methods of FrameFinderOf, for the files that compile one format each: in one file the compiler would inline less.
// They stand in the order of calls. Read poll(), idle() and received() first: they are in FrameFinder.h, since sketches
// inline them.
#include "FrameFinder.h"
#include "Slots.h"

namespace sbus {

namespace {

constexpr int JudgedWorth = 4;           // headers: one that judge() rejects costs as much as four without an end byte
constexpr int FarOff = FrameSize24 + 1;  // characters: the most that _expectedAt counts
constexpr uint32_t Unsteady = 2500;      // us: a frame comes late by less, parts of two by a period, 4 ms or more
constexpr int32_t ShortestPeriod = 5376;  // us: an X8R has 6 ms; what is shorter was measured between late polls

// Counts rare events. Not inlined: 40 bytes less on an AVR, 8 on a Cortex-M0+.
__attribute__((noinline)) void countUp(uint32_t &counter) {
  counter++;
}

}  // namespace

template <typename Format, typename Events>
void FrameFinderOf<Format, Events>::reset(uint32_t now, uint8_t characterTime, uint8_t idleCharacters) {
  _timing.reset(now, characterTime, idleCharacters);
  _acquisition.reset();
  _variant = UnknownVariant;
  _aligned = false;
  _hasBreaks = false;
  _unread = 0;
  _buffer.clear();
  startOver(rules::FirstOffBy);
  _counters = Counters();
  Events::begin();
}

// After lost bytes, or a silence longer than any frame period, the next character may stand anywhere in a frame.
template <typename Format, typename Events>
void FrameFinderOf<Format, Events>::startOver(int offBy) {
  const int count = _buffer.filled();
  _counters.discardedBytes += static_cast<unsigned>(count);
  Events::discarded(_buffer.bytes(), count);
  _buffer.clear();
  _expectedAt = static_cast<int8_t>(-offBy);
  _owed = false;
  _acquisition.forget(offBy == rules::FirstOffBy);
}

template <typename Format, typename Events>
void FrameFinderOf<Format, Events>::broken() {
  lost(_counters.overflows);
}

// Drops the incoming frame, because the port has lost bytes after it.
template <typename Format, typename Events>
void FrameFinderOf<Format, Events>::lost(uint32_t &counter) {
  countUp(counter);
  startOver(FarOff);
  Events::lost();
}

// While interrupts are off, a UART keeps a few characters and loses the others. If the line goes on at the same place
// of a later frame, 25 characters of two frames stand there without a gap, and only the time shows that. A frame that
// broke off may also have lost a character on the line: then there is an apparent gap. Otherwise the port has lost
// bytes.
template <typename Format, typename Events>
void FrameFinderOf<Format, Events>::checkFound() {
  const int filled = _buffer.filled();
  const int missing = filled == 0 || _buffer.gapAt() == filled ? 0 : Size - filled;
  if (_timing.template fallsShort<Format>(_found, missing, _counters.period, _acquisition.isStretched())) {
    if (!LineTiming::ClockRuns || static_cast<int>(_found) < missing) {
      _buffer.markGap(Silence::Likely);
    } else {
      _owed = static_cast<int32_t>(_counters.period) >= ShortestPeriod;
    }
  }
}

// Takes a certain gap before the next character. A run of the other size forgets the variant: on a line of that size
// two impaired frames may look like one of this size again and again.
template <typename Format, typename Events>
void FrameFinderOf<Format, Events>::gapBefore(Silence gap) {
  const int filled = _buffer.filled();
  if (gap == Silence::Wide && filled != 0 && filled < Size && _buffer.isHeader(0)) {
    uint8_t *const beginning = _buffer.bytes();
    countUp(_counters.rejectedByLength);
    Events::rejected(0, Rejection::GapInside);
    discard(filled);
    _buffer.restart(beginning);
  }
  _buffer.markGap(gap);
  if (!Events::seesEachGap()) {
    _acquisition.forget();
  }
  if (_acquisition.gap(filled, _variant == UnknownVariant)) {
    countUp(_counters.otherSizeFrames);
    _variant = UnknownVariant;
    _aligned = false;  // out of sync: isUsual() needs a variant
  }
}

// Takes the silence that the times show before the bytes that no poll has found yet. Returns how many bytes wait before
// it, if it is a gap: see pollIdling().
template <typename Format, typename Events>
int FrameFinderOf<Format, Events>::likelyGapAt(uint32_t silence, bool isWhole) {
  const int filled = _buffer.filled();
  const bool mayStop = isWhole && (_buffer.gapAt() == 0 || isDue());
  const bool isLikely = silence > (mayStop ? LineTiming::LongestStop : _timing.shortestGap());
  if (_unread != 0) {
    return isLikely ? _unread : 0;
  }
  if (silence >= LineTiming::LongSilence) {
    startOver(rules::FirstOffBy);
  } else if (silence > _timing.shortestGap() &&
             (_buffer.gapAt() == filled || _acquisition.isFrame() ||
              (filled == Size && (isDue() || _buffer.beginsWide())))) {
    gapBefore(silence > LineTiming::LongestStop ? Silence::Wide : Silence::Gap);
  } else if (isLikely) {
    likelyGap();
  }
  return 0;
}

// Takes a silence after the last byte. Returns the frame that waited for it, or nullptr.
template <typename Format, typename Events>
const uint8_t *FrameFinderOf<Format, Events>::settle(Silence gap) {
  if (gap == Silence::Unknown || (_buffer.gapAt() == _buffer.filled() && _buffer.gap() >= gap)) {
    return nullptr;
  }
  gapBefore(gap);
  startPoll(0);
  return _buffer.filled() < Size ? nullptr : search(0);
}

template <typename Format, typename Events>
const uint8_t *FrameFinderOf<Format, Events>::search(int waiting) {
  const bool isFrame =
      rules::isUsual<Format>(_buffer.bytes(), _buffer.filled(), _buffer.gapAt(), _variant, isDue()) || scan(waiting);
  noteEnd(waiting);
  return isFrame ? deliver() : nullptr;
}

// Notes when the frame that the buffer begins with was complete: once, in the poll that brought its end.
template <typename Format, typename Events>
inline void FrameFinderOf<Format, Events>::noteEnd(int waiting) {
  const int following = _buffer.filled() - Size;
  if (following >= 0 && static_cast<unsigned>(following + waiting) < _found) {
    _completeAfter = _timing.endedAfter(static_cast<unsigned>(following + waiting));
  }
}

// Returns true if a frame is complete.
template <typename Format, typename Events>
bool FrameFinderOf<Format, Events>::scan(int waiting) {
  uint8_t *const beginning = _buffer.bytes();
  bool found = find();
  if (Format::HasExtra && found && _buffer[0] == ExtraHeader) {
    takeExtra(waiting);
    found = false;
  }
  _buffer.moveTo(beginning);
  return found;
}

// Returns true if a frame is complete. The buffer then begins with it, and otherwise with what may become a frame.
template <typename Format, typename Events>
inline bool FrameFinderOf<Format, Events>::find() {
  while (rules::hasSlots<Format>(_variant) && _expectedAt == 0) {
    // A sensor's answer: the next frame is expected after it, and after a gap where the answer lacks a character. So
    // it is after a break, if an answer or a gap follows.
    const int untilGap = _buffer.gap() >= Silence::Gap ? _buffer.gapAt() : FrameBuffer<Format>::Nowhere;
    int size = SlotSize;
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
    if (variant != UnknownVariant) {
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
      step = verdict.next();
      worth = JudgedWorth;
    }
    // At most 24 headers of a poll are judged, as many as characters follow a frame's header.
    _rejected = static_cast<uint8_t>(_rejected + worth);
    start = _rejected < Size - 1 ? firstHeader(start + step) : _buffer.filled();
  }
  discard(start);
  return found;
}

template <typename Format, typename Events>
inline void FrameFinderOf<Format, Events>::takeExtra(int waiting) {
  noteEnd(waiting);
  countUp(_counters.extraFrames);
  Events::extra(_buffer.bytes(), _completeAfter);
  _expectedAt = 0;
  _buffer.drop(FrameSize);
}

// Returns the index of the first header from `from` on, or filled().
template <typename Format, typename Events>
inline int FrameFinderOf<Format, Events>::firstHeader(int from) const {
  const int filled = _buffer.filled();
  while (from < filled && !_buffer.isHeader(from)) {
    from++;
  }
  return from;
}

// Returns the variant whose form the 25 bytes at `start` have, or UnknownVariant.
template <typename Format, typename Events>
inline uint8_t FrameFinderOf<Format, Events>::variantAt(int start) {
  const uint8_t variant = variantOf(_buffer[start + EndAt]);
  if (variant == UnknownVariant) {
    countUp(_counters.rejectedByEnd);
    Events::rejected(start, Rejection::NoEnd);
  } else if (!rules::areFlags(_buffer[start + FlagsAt])) {
    countUp(_counters.rejectedByFlags);
    Events::rejected(start, Rejection::Flags);
    return UnknownVariant;
  }
  return variant;
}

// Inlined: a call would make a line of headers cost a fifth more.
template <typename Format, typename Events>
SBUS_IN_LINE Verdict FrameFinderOf<Format, Events>::judge(int start, uint8_t variant) {
  const int offBy = start - _expectedAt;
  const bool isFirst = start == 0;
  const bool isInSync = offBy == 0 && _aligned;
  const bool isInTime = _completeAfter - _frameTime < _counters.period + Unsteady;
  return rules::judge(
      Candidate<Format>{_buffer.bytes() + start, _buffer.filled() - start, _buffer.gapAt() - start, _buffer.gap(),
                        isFirst ? _buffer.inside() : Silence::Unknown,
                        isFirst && (isInSync && _counters.period != 0 ? isInTime : _buffer.beginsWide()), variant,
                        _variant, offBy, isInSync},
      _acquisition);
}

// Inlined: 13 cycles a frame less.
template <typename Format, typename Events>
SBUS_IN_LINE const uint8_t *FrameFinderOf<Format, Events>::deliver() {
  const uint8_t *const frame = _buffer.complete();
  if (_expectedAt < rules::MostNoise - Size && _counters.frames != 0) {
    countUp(_counters.resyncs);
  }
  _expectedAt = static_cast<int8_t>(LineVariants[_variant].tailSize);
  const uint32_t interval = _completeAfter - _frameTime;
  _counters.count(Format::flags(frame), interval);
  _frameTime = _completeAfter;
  _takenBy = _timing.lastPoll();
  Events::interval(interval);
  Events::taken(frame);
  return frame;
}

// Discards the first characters of the incoming frame.
template <typename Format, typename Events>
void FrameFinderOf<Format, Events>::discard(int count) {
  if (_expectedAt > -FarOff) {
    _expectedAt = static_cast<int8_t>(_expectedAt - count);
  }
  _counters.discardedBytes += static_cast<unsigned>(count);
  Events::discarded(_buffer.bytes(), count);
  _buffer.drop(count);
}

}  // namespace sbus

// Only the methods that others call: if the whole class were instantiated, nothing would be inlined.
#define SBUS_COMPILE_FINDER(...)                                                                                    \
  template void sbus::FrameFinderOf<__VA_ARGS__>::reset(uint32_t, uint8_t, uint8_t);                                \
  template void sbus::FrameFinderOf<__VA_ARGS__>::startOver(int);                                                   \
  template void sbus::FrameFinderOf<__VA_ARGS__>::broken();                                                         \
  template void sbus::FrameFinderOf<__VA_ARGS__>::lost(uint32_t &);                                                 \
  template void sbus::FrameFinderOf<__VA_ARGS__>::checkFound();                                                     \
  template void sbus::FrameFinderOf<__VA_ARGS__>::gapBefore(sbus::Silence);                                         \
  template int sbus::FrameFinderOf<__VA_ARGS__>::likelyGapAt(uint32_t, bool);                                       \
  template const uint8_t *sbus::FrameFinderOf<__VA_ARGS__>::settle(sbus::Silence);                                  \
  template const uint8_t *sbus::FrameFinderOf<__VA_ARGS__>::search(int);
