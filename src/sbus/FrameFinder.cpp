#include "FrameFinder.h"

#include <string.h>

namespace sbus {

namespace {

constexpr int MostNoise = 4;              // characters; more in a row are no noise
constexpr int LeastBurst = 5;             // characters: so many come at once if loop() was blocked
constexpr int MostRefused = 24;           // headers in a poll: a line that brings more is no S.Bus
constexpr int LongerBy = 36 - FrameSize;  // characters: FrSky's frames of 24 channels have 36
constexpr int FarOff = FrameSize;         // characters skipped; more need not be known
constexpr uint32_t LongBlock = 20000;     // us without a poll: what waited in the port is old

}  // namespace

void FrameFinder::reset(uint32_t now, uint8_t characterTime) {
  _pauses.reset(now, characterTime);
  _kind = UnknownKind;
  _idleAfter = false;
  _certain = false;
  _filled = 0;
  broken();
  _skipped = 0;
  _counters = Counters();
}

void FrameFinder::broken() {
  _counters.overflows++;
  _counters.skippedBytes += _filled;
  _skipped = FarOff;
  _sincePause = FarOff;
  _filled = 0;
  _pauseAt = Nowhere;
}

// Needed until the first frame only, and out of line: within poll() it would cost every frame 15 cycles.
void FrameFinder::learn(unsigned found, uint32_t quiet) {
  _idleAfter = !_pauseBefore && _pauses.idleAfter(found, quiet);
}

const uint8_t *FrameFinder::search() {
  return isUsual() || scan() ? deliver() : nullptr;
}

// Nearly all frames of a good line: judge() would say the same, and take 160 cycles longer. (The kind is known where
// nothing was skipped.)
inline bool FrameFinder::isUsual() const {
  return _filled == FrameSize && _certain && _skipped == 0 && (_pauseAt == 0 || _pauseAt == Nowhere) && isHeader(0) &&
         isFlagsByte(_incoming[FlagsIndex]) && endsKind(_incoming[EndIndex], _kind);
}

// True if a frame is complete. What find() leaves moves to the buffer's beginning: once, not for each header refused.
bool FrameFinder::scan() {
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
inline bool FrameFinder::find() {
  if (!isHeader(0)) {
    skip(firstHeader(0));
  }
  int start = 0;
  for (const int last = _filled - FrameSize; start <= last;) {
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
    start = ++_refused < MostRefused ? firstHeader(start + step) : _filled;
  }
  skip(start);
  return false;
}

// The first header from there on; _filled if there is none.
inline int FrameFinder::firstHeader(int from) const {
  while (from < _filled && !isHeader(from)) {
    from++;
  }
  return from;
}

// The kind of frame whose form 25 bytes have; UnknownKind if of none.
inline uint8_t FrameFinder::kindAt(int start) {
  const uint8_t *const frame = _incoming + start;
  const uint8_t kind = kindOfEnd(frame[EndIndex]);
  if (kind == UnknownKind) {
    _counters.refusedByEnd++;
  } else if (!isFlagsByte(frame[FlagsIndex])) {
    _counters.refusedByFlags++;
    return UnknownKind;
  }
  return kind;
}

// Of 25 bytes that have the form of a frame. extras/docs/receiver.md has the figures of all rules. (In line: a call
// would make a line of headers cost a fifth more.)
__attribute__((always_inline)) inline int FrameFinder::judge(int start, uint8_t kind) {
  const uint8_t *const frame = _incoming + start;
  const int filled = _filled - start;
  const int pauseAt = _pauseAt - start;
  // A pause inside: halves of two frames, as S.BUS2 at rest has them (9321 wrong frames without this, 1 with it).
  if (pauseAt > 0 && pauseAt < FrameSize && !wasBlocked(start)) {
    return pauseAt;
  }
  // It is whole before a pause or a header. One of the line's kind is whole at once, unless its end comes twice, as if
  // a noise character stood before the true header (1642 wrong, 40), or more follows than noise (141 wrong, 77).
  const LineKind &line = LineKinds[kind];
  const int size = FrameSize + line.tailSize;
  const bool pauseAfter = pauseAt >= FrameSize && pauseAt <= size;
  if (!pauseAfter && filled <= size) {
    if (kind != _kind && !(filled == size && _idleAfter)) {
      return Wait;
    }
  } else if (!pauseAfter && (frame[size] & line.headerMask) != HeaderByte &&
             (kind != _kind || frame[size] == frame[EndIndex] ||
              (filled > size + MostNoise && frame[size + 1] != HeaderByte))) {
    return 1;
  }
  // The rest of a longer frame (of FrSky's 24 channels at rest 2298 are believed without this, 427 with it).
  const int sincePause = pauseAt <= 0 ? -pauseAt : _sincePause + start;
  if (kind != _kind && sincePause > MostNoise && sincePause <= LongerBy) {
    return 1;
  }
  // Where its place is not certain it may be the halves of two frames (70496 second readings of a failsafe frame, 0).
  const bool certain = ((pauseAfter || pauseAt == 0) && _pauses.areSure()) || (_certain && _skipped == -start);
  const int inner = certain ? FrameSize : innerHeader(frame, line.endMask);
  if (inner < FrameSize) {
    return inner;
  }
  skip(start);
  _kind = kind;
  _idleAfter = false;
  _certain = certain || _skipped == 0;
  return Deliver;
}

// loop() was blocked while a frame came in that was expected here: what seems to be a pause was none (3143 frames
// missed without this, 1300 with it).
inline bool FrameFinder::wasBlocked(int start) const {
  return _skipped == -start && _pauseBefore && _pauseAt - start <= FrameSize - LeastBurst && !isHeader(_pauseAt);
}

inline const uint8_t *FrameFinder::deliver() {
  uint8_t *const frame = _incoming;
  _incoming = _complete;
  _complete = frame;
  drop(FrameSize);
  if (_filled != 0) {
    memcpy(_incoming, frame + FrameSize, _filled);
  }
  if (_skipped > FrameSize - MostNoise && _counters.frames != 0) {
    _counters.resyncs++;
  }
  _skipped = static_cast<int8_t>(-LineKinds[_kind].tailSize);
  _sincePause = NoPause;
  const uint32_t time = _pauses.lastPoll() - (_quiet > LongBlock ? _quiet : 0);
  _counters.count(frame[FlagsIndex], time - _frameTime);
  _frameTime = time;
  return frame;
}

// The first characters of the incoming frame belong to none.
void FrameFinder::skip(int count) {
  if (_skipped < FarOff) {
    _skipped = static_cast<int8_t>(_skipped + count);
  }
  if (_pauseAt <= count) {
    _sincePause = static_cast<uint8_t>(count - _pauseAt);
  } else if (_sincePause < FarOff) {
    _sincePause = static_cast<uint8_t>(_sincePause + count);
  } else if (isHeader(0)) {
    _sincePause = FarOff;
  } else if (_sincePause == NoPause && _skipped > MostNoise) {
    _kind = UnknownKind;
  }
  _counters.skippedBytes += static_cast<unsigned>(count);
  _incoming += count;
  drop(count);
}

inline void FrameFinder::drop(int count) {
  _filled = static_cast<uint8_t>(_filled - count);
  if (_pauseAt != Nowhere) {
    _pauseAt = static_cast<uint8_t>(_pauseAt < count ? Nowhere : _pauseAt - count);
  }
}

}  // namespace sbus
