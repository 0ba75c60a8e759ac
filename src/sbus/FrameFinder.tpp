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
  _variant = UnknownVariant;
  _certain = false;
  _buffer.clear();
  startOver(rules::FirstOffBy);
  _counters = Counters();
}

// After a break, or a silence longer than any frame period: the next character may stand anywhere in a frame.
template <typename Format, typename Events>
void FrameFinderOf<Format, Events>::startOver(int offBy) {
  const int count = _buffer.filled();
  _counters.discardedBytes += static_cast<unsigned>(count);
  Events::discarded(count);
  _buffer.clear();
  _expectedAt = static_cast<int8_t>(-offBy);
  _onlyNoise = false;
  _acquisition.forget(offBy == rules::FirstOffBy);
}

template <typename Format, typename Events>
void FrameFinderOf<Format, Events>::broken() {
  countUp(_counters.overflows);
  startOver(FarOff);
}

// A gap stands before the next character, for certain. Of a line of the other size two impaired frames may look like one
// of this size, and the same ones again and again.
template <typename Format, typename Events>
void FrameFinderOf<Format, Events>::gapBefore() {
  _buffer.markGap(true);
  if (!Events::seesEachGap()) {
    _acquisition.forget();
  }
  if (_acquisition.gap(_buffer.filled(), _variant == UnknownVariant)) {
    countUp(_counters.otherSizeFrames);
    _variant = UnknownVariant;
  }
}

// A frame waits for what follows it. Is it silence?
template <typename Format, typename Events>
const uint8_t *FrameFinderOf<Format, Events>::settle() {
  if (!_timing.template isSilent<Format>() || _buffer.gapAt() == _buffer.filled()) {
    return nullptr;
  }
  gapBefore();
  _rejected = 0;
  _found = 0;
  return search(0);
}

template <typename Format, typename Events>
const uint8_t *FrameFinderOf<Format, Events>::search(int waiting) {
  const bool isSure = _certain && _expectedAt == 0;
  const bool isFrame =
      rules::isUsual<Format>(_buffer.bytes(), _buffer.filled(), _buffer.gapAt(), _variant, isSure) || scan(waiting);
  noteEnd(waiting);
  return isFrame ? deliver() : nullptr;
}

// When the frame at the buffer's beginning was complete: it is noted once, in the poll that brought its end.
template <typename Format, typename Events>
inline void FrameFinderOf<Format, Events>::noteEnd(int waiting) {
  const int behind = _buffer.filled() - Size;
  if (behind >= 0 && static_cast<unsigned>(behind + waiting) < _found) {
    _completeAfter = _timing.endedAfter(static_cast<unsigned>(behind + waiting));
  }
}

// True if a frame is complete.
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

// True if a frame is complete. The buffer begins with it then, or with what may become one.
template <typename Format, typename Events>
inline bool FrameFinderOf<Format, Events>::find() {
  while (Format::HasExtra && _variant == SlotsVariant && _expectedAt == 0 && isSlotId(_buffer[0]) && holds(Rule::slots)) {
    // The answer of a sensor: the next frame is expected behind it.
    if (_buffer.filled() < SlotSize) {
      return false;
    }
    discard(SlotSize);
    _expectedAt = 0;
  }
  discard(firstHeader(0));
  int start = 0;
  bool found = false;
  for (const int last = _buffer.filled() - Size; start <= last;) {
    int step = 1, worth = 1;
    const uint8_t variant = variantAt(start);
    if (variant != UnknownVariant) {
      const Verdict verdict = judge(start, variant);
      if (verdict.isAccepted()) {
        _variant = variant;
        _certain = verdict.isCertain();
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
    // A frame has 24 characters after its header: after as many rejected ones the rest of a poll is not searched.
    _rejected = static_cast<uint8_t>(_rejected + worth);
    start = _rejected < Size - 1 ? firstHeader(start + step) : _buffer.filled();
  }
  discard(start);
  return found;
}

template <typename Format, typename Events>
inline void FrameFinderOf<Format, Events>::takeExtra(int waiting) {
  noteEnd(waiting);
  memcpy(_extra, _buffer.bytes(), FrameSize);
  _extraTime = _completeAfter;
  countUp(_counters.extraFrames);
  Events::extra();
  _expectedAt = 0;
  _buffer.drop(FrameSize);
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

// The variant of frame whose form 25 bytes have; UnknownVariant if of none.
template <typename Format, typename Events>
inline uint8_t FrameFinderOf<Format, Events>::variantAt(int start) {
  const uint8_t variant = kindOf(_buffer[start + EndAt]);
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

// In line: a call would make a line of headers cost a fifth more.
template <typename Format, typename Events>
SBUS_IN_LINE Verdict FrameFinderOf<Format, Events>::judge(int start, uint8_t variant) {
  const int offBy = start - _expectedAt;
  return rules::judge(Candidate<Format>{_buffer.bytes() + start, _buffer.filled() - start, _buffer.gapAt() - start,
                                        _buffer.isGapCertain(), variant, _variant, offBy, offBy == 0 && _certain},
                      _acquisition);
}

// In line: 13 cycles a frame less.
template <typename Format, typename Events>
SBUS_IN_LINE const uint8_t *FrameFinderOf<Format, Events>::deliver() {
  const uint8_t *const frame = _buffer.complete();
  if (_expectedAt < rules::MostNoise - Size && _counters.frames != 0) {
    countUp(_counters.resyncs);
  }
  _expectedAt = static_cast<int8_t>(LineVariants[_variant].tailSize);
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
    _variant = UnknownVariant;
  }
  _counters.discardedBytes += static_cast<unsigned>(count);
  Events::discarded(count);
  _buffer.drop(count);
}

}  // namespace sbus

// Only what others call: of a whole class nothing would be compiled in line.
#define SBUS_COMPILE_FINDER(...)                                                       \
  template void sbus::FrameFinderOf<__VA_ARGS__>::reset(uint32_t, uint8_t, uint8_t);   \
  template void sbus::FrameFinderOf<__VA_ARGS__>::startOver(int);                      \
  template void sbus::FrameFinderOf<__VA_ARGS__>::broken();                            \
  template void sbus::FrameFinderOf<__VA_ARGS__>::gapBefore();                         \
  template const uint8_t *sbus::FrameFinderOf<__VA_ARGS__>::settle();                  \
  template const uint8_t *sbus::FrameFinderOf<__VA_ARGS__>::search(int);
