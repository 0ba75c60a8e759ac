// FrameFinderOf, for the two files that compile it: in one file the compiler would take less of it in line.
#include <string.h>

#include "FrameFinder.h"

namespace sbus {

namespace {

constexpr int MostNoise = 4;             // characters; more in a row are no noise
constexpr int LeastBurst = 5;            // characters: so many come at once if loop() was blocked
constexpr int FarOff = FrameSize24 + 1;  // characters; more need not be known
constexpr int LongAgo = UINT8_MAX;       // characters: a line without a pause in them shows none
constexpr uint8_t LongMemory = 8;        // pauses without a frame of the other size until that is forgotten
constexpr uint32_t LongBlock = 20000;    // us without a poll: what waited in the port is old

}  // namespace

template <typename Format>
void FrameFinderOf<Format>::reset(uint32_t now, uint8_t characterTime) {
  _pauses.reset(now, characterTime);
  _kind = UnknownKind;
  _idleAfter = false;
  _certain = false;
  _filled = 0;
  _others = 0;
  broken();
  _skipped = 0;
  _counters = Counters();
}

template <typename Format>
void FrameFinderOf<Format>::broken() {
  _counters.overflows++;
  _counters.skippedBytes += _filled;
  _skipped = FarOff;
  _onlyNoise = false;
  _sincePause = LongAgo;
  _filled = 0;
  _pauseAt = Nowhere;
}

// Needed until the first frame only, and out of line: within poll() it would cost every frame 15 cycles.
template <typename Format>
void FrameFinderOf<Format>::learn(unsigned found, uint32_t quiet) {
  _idleAfter = !_pauseBefore && _pauses.idleAfter(found, quiet);
  if (_pauseBefore) {
    if (_sincePause == Format::OtherSize) {
      _counters.otherFrames++;
      _others = LongMemory;
    } else if (_sincePause == Size) {
      _others = 0;
    } else if (_filled >= Size && _sincePause > _filled && _sincePause < LongAgo) {
      _others |= 1;  // characters came straight before what waits in the buffer
    } else if (_others > 0) {
      _others--;
    }
    _sincePause = 0;
  }
  _sincePause = static_cast<uint8_t>(static_cast<int>(found) < LongAgo - _sincePause ? _sincePause + found : LongAgo);
}

template <typename Format>
const uint8_t *FrameFinderOf<Format>::search() {
  return isUsual() || scan() ? deliver() : nullptr;
}

// Nearly all frames of a good line: judge() would say the same, and take 160 cycles longer. (The kind is known where
// nothing was skipped.)
template <typename Format>
inline bool FrameFinderOf<Format>::isUsual() const {
  return _filled == Size && _certain && _skipped == 0 && (_pauseAt == 0 || _pauseAt == Nowhere) && isHeader(0) &&
         isFlagsByte(_incoming[FlagsAt]) && endsKind(_incoming[EndAt], _kind);
}

// True if a frame is complete. What find() leaves moves to the buffer's beginning: once, not for each header refused.
template <typename Format>
bool FrameFinderOf<Format>::scan() {
  uint8_t *const beginning = _incoming;
  const bool found = find();
  if (_incoming != beginning) {
    const uint8_t *const left = _incoming;
    const int count = _filled;
    _incoming = beginning;
    if (count != 0) {
      int i = 0;
      do {  // 100 cycles quicker than memmove()
        beginning[i] = left[i];
      } while (++i < count);
    }
  }
  return found;
}

// True if a frame is complete. Moves _incoming on to it, or to where one may begin.
template <typename Format>
inline bool FrameFinderOf<Format>::find() {
  if (!isHeader(0)) {
    if (Format::HasExtra && takesExtra()) {
      return false;
    }
    skip(firstHeader(0));
  }
  int start = 0;
  for (const int last = _filled - Size; start <= last;) {
    int step = 1;
    const uint8_t kind = kindAt(start);
    if (kind != UnknownKind) {
      step = judge(start, kind);
      if (step == Deliver) {
        return true;
      }
      if (step == Wait) {
        break;
      }
      _counters.refusedByExtra++;
    }
    start = ++_refused < Size - 1 ? firstHeader(start + step) : _filled;
  }
  if (Format::HasExtra && _pauseAt < start && _incoming[_pauseAt] == ExtraHeader) {
    start = _pauseAt;  // takesExtra() is asked next
  }
  skip(start);
  return false;
}

// A frame with further channels stands where a frame is expected, or may: true while it is not known. It is believed
// only there, on a line whose kind is known, and with a header or a pause after it: a noise character 2F straight
// before a frame would else take that frame for its own.
template <typename Format>
inline bool FrameFinderOf<Format>::takesExtra() {
  if (_incoming[0] != ExtraHeader || (_skipped != 0 && _pauseAt > FrameSize) ||
      (_pauseAt > 0 && _pauseAt < FrameSize)) {
    return false;
  }
  if (_kind == UnknownKind) {
    _sincePause = LongAgo;  // the first frame may follow without a pause
    return false;
  }
  _onlyNoise = false;
  const bool pauseAfter = _pauseAt == FrameSize;
  if (!pauseAfter && _filled <= FrameSize) {
    return true;
  }
  if ((pauseAfter || isHeader(FrameSize)) && isFlagsByte(_incoming[FlagsIndex]) &&
      endsKind(_incoming[EndIndex], _kind)) {
    memcpy(_extra, _incoming, FrameSize);
    _extraTime = _pauses.lastPoll() - _quiet;  // at the latest: what follows it came with this poll
    _counters.extraFrames++;
    _certain = true;
    _skipped = 0;
    _incoming += FrameSize;
    drop(FrameSize);
  }
  return false;
}

// The first header from there on; _filled if there is none.
template <typename Format>
inline int FrameFinderOf<Format>::firstHeader(int from) const {
  while (from < _filled && !isHeader(from)) {
    from++;
  }
  return from;
}

// The kind of frame whose form 25 bytes have; UnknownKind if of none.
template <typename Format>
inline uint8_t FrameFinderOf<Format>::kindAt(int start) {
  const uint8_t *const frame = _incoming + start;
  const uint8_t kind = kindOf(frame[EndAt]);
  if (kind == UnknownKind) {
    _counters.refusedByEnd++;
  } else if (!isFlagsByte(frame[FlagsAt])) {
    _counters.refusedByFlags++;
    return UnknownKind;
  }
  return kind;
}

// Of 25 bytes that have the form of a frame. extras/docs/receiver.md has the figures of all rules. (In line: a call
// would make a line of headers cost a fifth more.)
template <typename Format>
__attribute__((always_inline)) inline int FrameFinderOf<Format>::judge(int start, uint8_t kind) {
  const uint8_t *const frame = _incoming + start;
  const int filled = _filled - start;
  const int pauseAt = _pauseAt - start;
  // A pause inside: halves of two frames, as S.BUS2 at rest has them (10153 wrong frames without this, 1 with it).
  if (pauseAt > 0 && pauseAt < Size && !wasBlocked(start)) {
    return pauseAt;
  }
  // It is whole before a pause or a header. One of the line's kind is whole at once, unless its end comes twice, as if
  // a noise character stood before the true header (1642 wrong, 40), or more follows than noise (144 wrong, 81).
  const LineKind &line = LineKinds[kind];
  const int size = Size + line.tailSize;
  const bool pauseAfter = pauseAt >= Size && pauseAt <= size;
  if (!pauseAfter && filled <= size) {
    if (kind != _kind && !(filled == size && _idleAfter)) {
      return Wait;
    }
  } else if (!pauseAfter && (frame[size] & line.headerMask) != HeaderByte &&
             (kind != _kind || frame[size] == frame[EndAt] ||
              (filled > size + MostNoise && frame[size + 1] != HeaderByte))) {
    return 1;
  }
  // A line of longer frames, or shorter ones: a part of one, or of two, may look like a frame. The first stands at a
  // pause, if pauses are seen.
  const bool atPause = pauseAfter || pauseAt == 0;
  if (kind != _kind && (_others > 0 || (!atPause && _sincePause < LongAgo))) {
    return 1;
  }
  // Where its place is not certain it may be the halves of two frames (70496 second readings of a failsafe frame, 0).
  const bool certain = (atPause && _pauses.areSure()) || (_certain && _skipped == -start);
  const int inner = certain ? Size : innerHeader(frame, Size, line.endMask);
  if (inner < Size) {
    // A pause after it may make it certain yet, unless so few characters may be the rest of a frame before. Straight
    // after a frame none waits.
    return inner < Size / 2 || pauseAfter || filled > size || _skipped == -start ? inner : Wait;
  }
  skip(start);
  _kind = kind;
  _idleAfter = false;
  _sincePause = LongAgo;
  _certain = certain || _skipped == 0;
  return Deliver;
}

// loop() was blocked while a frame came in that was expected here: what seems to be a pause was none (3776 frames
// missed without this, 1512 with it).
template <typename Format>
inline bool FrameFinderOf<Format>::wasBlocked(int start) const {
  return _skipped == -start && _pauseBefore && _pauseAt - start <= Size - LeastBurst && !isHeader(_pauseAt);
}

template <typename Format>
inline const uint8_t *FrameFinderOf<Format>::deliver() {
  uint8_t *const frame = _incoming;
  _incoming = _complete;
  _complete = frame;
  drop(Size);
  if (_filled != 0) {
    memcpy(_incoming, frame + Size, _filled);
  }
  if (_skipped > Size - MostNoise && _counters.frames != 0) {
    _counters.resyncs++;
  }
  _skipped = static_cast<int8_t>(-LineKinds[_kind].tailSize);
  _onlyNoise = true;
  const bool waited = _pauseAt <= LongestTail;  // for the pause after it: it was there at the poll before
  const uint32_t time = _pauses.lastPoll() - (waited || _quiet > LongBlock ? _quiet : 0);
  _counters.count(frame[FlagsAt], time - _frameTime);
  _frameTime = time;
  return frame;
}

// The first characters of the incoming frame belong to none.
template <typename Format>
void FrameFinderOf<Format>::skip(int count) {
  if (_skipped < FarOff) {
    _skipped = static_cast<int8_t>(_skipped + count);
  }
  if (_pauseAt <= count || isHeader(0)) {
    _onlyNoise = false;
  } else if (_onlyNoise && _skipped > MostNoise) {
    _kind = UnknownKind;
  }
  _counters.skippedBytes += static_cast<unsigned>(count);
  _incoming += count;
  drop(count);
}

template <typename Format>
__attribute__((always_inline)) inline void FrameFinderOf<Format>::drop(int count) {
  _filled = static_cast<uint8_t>(_filled - count);
  if (_pauseAt != Nowhere) {
    _pauseAt = static_cast<uint8_t>(_pauseAt < count ? Nowhere : _pauseAt - count);
  }
}

}  // namespace sbus

// Only what others call: of a whole class nothing would be compiled in line.
#define SBUS_COMPILE_FINDER(Format)                                     \
  template void sbus::FrameFinderOf<Format>::reset(uint32_t, uint8_t);  \
  template void sbus::FrameFinderOf<Format>::broken();                  \
  template void sbus::FrameFinderOf<Format>::learn(unsigned, uint32_t); \
  template const uint8_t *sbus::FrameFinderOf<Format>::search();
