// FrameFinderOf, for the two files that compile it: in one file the compiler would take less of it in line.
#include <string.h>

#include "FrameFinder.h"

namespace sbus {

namespace {

constexpr int SlotSize = 3;              // characters
constexpr int JudgedWorth = 4;            // a header that is rejected by the whole judgement costs as much as so many others
constexpr int FarOff = FrameSize24 + 1;  // characters; more need not be known

// What is counted seldom. Out of line: 40 bytes less on an AVR, 8 on a Cortex-M0+.
__attribute__((noinline)) void countUp(uint32_t &counter) {
  counter++;
}

}  // namespace

template <typename Format, typename Events>
void FrameFinderOf<Format, Events>::reset(uint32_t now, uint8_t characterTime, uint8_t idleCharacters) {
  _timing.reset(now, characterTime, idleCharacters);
  _acquisition.reset();
  _kind = UnknownKind;
  _certain = false;
  _buffer.clear();
  startOver(Silent);
  _counters = Counters();
}

// After a break, or a silence longer than any frame period: the next character may stand anywhere in a frame.
template <typename Format, typename Events>
void FrameFinderOf<Format, Events>::startOver(int offBy) {
  const int count = _buffer.filled();
  _counters.skippedBytes += static_cast<unsigned>(count);
  Events::discarded(count);
  _buffer.clear();
  _expectedAt = static_cast<int8_t>(-offBy);
  _onlyNoise = false;
  _acquisition.forget(offBy == Silent);
}

template <typename Format, typename Events>
void FrameFinderOf<Format, Events>::broken() {
  countUp(_counters.overflows);
  startOver(FarOff);
}

// Of a line of the other size two damaged frames may look like one of this size, and the same ones again and again.
template <typename Format, typename Events>
void FrameFinderOf<Format, Events>::gapBefore() {
  if (_acquisition.gap(_buffer.filled(), _kind == UnknownKind)) {
    countUp(_counters.otherFrames);
    _kind = UnknownKind;
  }
}

// A frame waits for what follows it. Is it silence?
template <typename Format, typename Events>
const uint8_t *FrameFinderOf<Format, Events>::settle() {
  if (!_timing.template isSilent<Format>() || _buffer.gapAt() == _buffer.filled()) {
    return nullptr;
  }
  _buffer.markGap(true);
  gapBefore();
  _rejected = 0;
  return search(0);
}

template <typename Format, typename Events>
const uint8_t *FrameFinderOf<Format, Events>::search(int waiting) {
  const bool isSure = _certain && _expectedAt == 0;
  const bool isFrame =
      rules::isUsual<Format>(_buffer.bytes(), _buffer.filled(), _buffer.gapAt(), _kind, isSure) || scan(waiting);
  noteEnd(waiting);
  return isFrame ? deliver() : nullptr;
}

// When the frame at the buffer's beginning was complete: it is noted once, in the poll that brought its end.
template <typename Format, typename Events>
inline void FrameFinderOf<Format, Events>::noteEnd(int waiting) {
  const int behind = _buffer.filled() - Size;
  if (behind >= 0 && _old < Size) {
    _completeAfter = _timing.endedAfter(static_cast<unsigned>(behind + waiting));
  }
}

// True if a frame is complete.
template <typename Format, typename Events>
bool FrameFinderOf<Format, Events>::scan(int waiting) {
  uint8_t *const beginning = _buffer.bytes();
  const bool found = find(waiting);
  _buffer.moveTo(beginning);
  return found;
}

// True if a frame is complete. The buffer begins with it then, or with what may become one.
template <typename Format, typename Events>
inline bool FrameFinderOf<Format, Events>::find(int waiting) {
  while (int count = firstHeader(0)) {
    if (Format::HasExtra && _expectedAt == 0 && _kind == SlotsKind && isSlotId(_buffer[0]) && holds(Rule::slots)) {
      // The answer of a sensor: the next frame is expected behind it.
      count = _buffer.gapAt() > 0 && _buffer.gapAt() < SlotSize ? _buffer.gapAt() : SlotSize;
      if (_buffer.filled() < count) {
        return false;
      }
      _expectedAt = static_cast<int8_t>(count);
    } else if (Format::HasExtra && mayBeExtra()) {
      const Verdict verdict = judgeExtra();
      if (verdict.isOpen()) {
        return false;
      }
      if (verdict.isAccepted()) {
        takeExtra(waiting);
        continue;
      }
    }
    discard(count);
  }
  int start = 0;
  for (const int last = _buffer.filled() - Size; start <= last;) {
    int step = 1, worth = 1;
    const uint8_t kind = kindAt(start);
    if (kind != UnknownKind) {
      const Verdict verdict = judge(start, kind);
      if (verdict.isAccepted()) {
        discard(start);
        _kind = kind;
        _certain = verdict.isCertain();
        return true;
      }
      if (verdict.isOpen()) {
        break;
      }
      countUp(_counters.refusedByExtra);
      Events::rejected(start, verdict.why());
      step = verdict.next();
      worth = JudgedWorth;
    }
    // A frame has 24 characters after its header: after as many rejected ones the rest of a poll is not searched.
    _rejected = static_cast<uint8_t>(_rejected + worth);
    start = _rejected < Size - 1 ? firstHeader(start + step) : _buffer.filled();
  }
  if (Format::HasExtra && holds(Rule::extra) && _buffer.gapAt() < start && _buffer[_buffer.gapAt()] == ExtraHeader) {
    start = _buffer.gapAt();  // mayBeExtra() is asked next
  }
  discard(start);
  return false;
}

// A frame with further channels stands where a frame is expected, or after a gap: a noise character 2F straight before
// a frame would else take that frame for its own.
template <typename Format, typename Events>
inline bool FrameFinderOf<Format, Events>::mayBeExtra() const {
  const int gapAt = _buffer.gapAt();
  return _buffer[0] == ExtraHeader && (_expectedAt == 0 || gapAt <= FrameSize) && (gapAt == 0 || gapAt >= FrameSize);
}

// It is believed only on a line whose kind is known, and with a header or a gap after it.
template <typename Format, typename Events>
inline Verdict FrameFinderOf<Format, Events>::judgeExtra() {
  if (_kind == UnknownKind) {
    _acquisition.forget();  // the first frame may follow without a gap
    return Verdict::reject(Rejection::NotAtGap);
  }
  _onlyNoise = false;
  if (_buffer.gapAt() != FrameSize) {
    if (_buffer.filled() <= FrameSize) {
      return Verdict::wait();
    }
    if (!_buffer.isHeader(FrameSize)) {
      return Verdict::reject(Rejection::GoesOn);
    }
  }
  return rules::areFlags(_buffer[FlagsIndex]) && endsKind(_buffer[EndIndex], _kind)
             ? Verdict::accept(true)
             : Verdict::reject(Rejection::NoEnd);
}

template <typename Format, typename Events>
inline void FrameFinderOf<Format, Events>::takeExtra(int waiting) {
  noteEnd(waiting);
  memcpy(_extra, _buffer.bytes(), FrameSize);
  _extraTime = _completeAfter;
  countUp(_counters.extraFrames);
  Events::extra();
  _certain = true;
  _expectedAt = 0;
  _buffer.drop(FrameSize);
  _old = 0;
}

// The first header from there on; filled() if there is none.
template <typename Format, typename Events>
inline int FrameFinderOf<Format, Events>::firstHeader(int from) const {
  const int filled = _buffer.filled();
  while (from < filled && !_buffer.isHeader(from)) {
    from++;
  }
  return from;
}

// The kind of frame whose form 25 bytes have; UnknownKind if of none.
template <typename Format, typename Events>
inline uint8_t FrameFinderOf<Format, Events>::kindAt(int start) {
  const uint8_t kind = kindOf(_buffer[start + EndAt]);
  if (kind == UnknownKind) {
    countUp(_counters.refusedByEnd);
    Events::rejected(start, Rejection::NoEnd);
  } else if (!rules::areFlags(_buffer[start + FlagsAt])) {
    countUp(_counters.refusedByFlags);
    Events::rejected(start, Rejection::Flags);
    return UnknownKind;
  }
  return kind;
}

// In line: a call would make a line of headers cost a fifth more.
template <typename Format, typename Events>
__attribute__((always_inline)) inline Verdict FrameFinderOf<Format, Events>::judge(int start, uint8_t kind) {
  const int offBy = start - _expectedAt;
  return rules::judge(Candidate<Format>{_buffer.bytes() + start, _buffer.filled() - start, _buffer.gapAt() - start,
                                        _buffer.isGapCertain(), kind, _kind, offBy, offBy == 0 && _certain},
                      _acquisition);
}

// In line: 13 cycles a frame less.
template <typename Format, typename Events>
SBUS_IN_LINE const uint8_t *FrameFinderOf<Format, Events>::deliver() {
  const uint8_t *const frame = _buffer.complete();
  _old = 0;  // what is left is less than a frame
  if (_expectedAt < rules::MostNoise - Size && _counters.frames != 0) {
    _counters.resyncs++;
  }
  _expectedAt = static_cast<int8_t>(LineKinds[_kind].tailSize);
  _onlyNoise = true;
  _counters.count(frame[FlagsAt], _completeAfter - _frameTime);
  _frameTime = _completeAfter;
  Events::taken();
  return frame;
}

// The first characters of the incoming frame belong to none.
template <typename Format, typename Events>
void FrameFinderOf<Format, Events>::discard(int count) {
  if (_expectedAt > -FarOff) {
    _expectedAt = static_cast<int8_t>(_expectedAt - count);
  }
  if (_buffer.gapAt() <= count || _buffer.isHeader(0)) {
    _onlyNoise = false;
  } else if (_onlyNoise && _expectedAt < -rules::MostNoise) {
    _kind = UnknownKind;
  }
  _counters.skippedBytes += static_cast<unsigned>(count);
  Events::discarded(count);
  _buffer.drop(count);
  _old = static_cast<uint8_t>(_old > count ? _old - count : 0);
}

}  // namespace sbus

// Only what others call: of a whole class nothing would be compiled in line.
#define SBUS_COMPILE_FINDER(...)                                              \
  template void sbus::FrameFinderOf<__VA_ARGS__>::reset(uint32_t, uint8_t, uint8_t); \
  template void sbus::FrameFinderOf<__VA_ARGS__>::startOver(int);             \
  template void sbus::FrameFinderOf<__VA_ARGS__>::broken();                   \
  template void sbus::FrameFinderOf<__VA_ARGS__>::gapBefore();                \
  template const uint8_t *sbus::FrameFinderOf<__VA_ARGS__>::settle();         \
  template const uint8_t *sbus::FrameFinderOf<__VA_ARGS__>::search(int);   
