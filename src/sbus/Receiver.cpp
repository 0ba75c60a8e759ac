#include "Receiver.h"

#include <string.h>

namespace sbus {

namespace {

// How far from the place where it is due a header still counts as the one: characters that the frame before it may have
// lost (of 25, at 1 of 50 lost, more than five are in one frame of 100000), or gained.
constexpr int Early = 5;
constexpr int Late = 3;
constexpr int LaterEachTime = 2;  // if one did not come, the place where it was due was perhaps wrong

// After so many headers that did not come where they were due, nothing is known of where they are due.
constexpr uint8_t Lost = 6;
constexpr uint8_t Unsure = Lost - 1;  // one more chance; what the last frame was like is forgotten

// The first so many, or the last so many bytes of 25 are rather noise before, or the beginning of, another frame.
constexpr uint8_t FewAhead = 4;
constexpr uint8_t FewBehind = 4;

// So many more characters straight behind a frame are no noise: they are the rest of a longer one.
constexpr uint8_t ManyMore = 4;

// Frames with further channels begin with 2F (FASSTest 26): such a header, too, ends what stands before it.
constexpr uint8_t HeaderMask = 0xDF;

// What a look costs that begins with another header at the same place as the last such look, in frames; one that begins
// with the frames' own brings as much. So chance, once in sixteen frames, does no harm, but a place where every second
// look begins soon wins, as on a line whose pauses are too short to be seen. At most 64: a wrong place is found with
// little trust, and soon left.
constexpr uint8_t Doubt = 4;
constexpr uint8_t LittleTrust = 8;
constexpr uint8_t FullTrust = 64;

constexpr uint8_t PeriodShift = 3;  // the measured period moves by an eighth of what is new

}  // namespace

void Receiver::reset(uint32_t now, uint8_t characterTime) {
  _pauses.reset(now, characterTime);
  _shortened = FrameSize - 1;
  _hasFrame = false;
  _disputed = 0;
  _rivalAt = 0;
  _distrust = 0u - LittleTrust;
  _due = 0;
  _filled = 0;
  broken();
  _counters = Counters();
  _pauseAt = 0;  // what was before is unknown, and the first frame may begin at once
}

void Receiver::broken() {
  _counters.overflows++;
  _counters.skippedBytes += _filled;
  _filled = 0;
  _pauseAt = Nowhere;
  _misses = Lost;
  _aligned = false;
}

const uint8_t *Receiver::received(int count, int waiting, uint32_t now) {
  const uint32_t quiet = _pauses.quiet(now);
  if (count <= 0) {
    return _filled == FrameSize && _pauses.isSilence(quiet) ? deliver() : nullptr;
  }
  if (quiet != 0) {
    _lookAt = _filled;
    if (_pauses.before(static_cast<unsigned>(count + waiting), quiet)) {
      _pauseAt = _filled;
    } else if (headerAt(_filled)) {
      weigh();
    }
  }
  _filled = static_cast<uint8_t>(_filled + count);
  if (!_aligned || !headerAt(0)) {
    align(0);
  }
  if (_filled < FrameSize) {
    return nullptr;
  }
  return likeTheLast() ? deliver() : search(waiting, quiet);
}

// The usual case, made quick: alone, behind the last frame, with the same flags and end byte, and not mayBeShifted().
inline bool Receiver::likeTheLast() const {
  const uint8_t *const frame = _incoming;
  const uint8_t *const last = _complete;
  return _filled == FrameSize && _place == Place::BehindFrame && !pauseInside() && frame[EndIndex] == last[EndIndex] &&
         frame[FlagsIndex] == last[FlagsIndex] && !isFlagsByte(last[FlagsIndex - 1]);
}

inline const uint8_t *Receiver::search(int waiting, uint32_t quiet) {
  _waiting = static_cast<uint8_t>(waiting);
  while (_filled >= FrameSize) {
    const Verdict verdict = judge();
    if (verdict == Verdict::Wait) {
      break;
    }
    if (verdict == Verdict::Deliver) {
      const bool waited = _lookAt == FrameSize;
      const uint8_t *const found = deliver();
      if (waited) {  // it came with the look before, and is as old as that
        _frameTime -= quiet;
        _counters.period -= quiet >> PeriodShift;
      }
      return found;
    }
    if (_place >= Place::BehindPause) {
      _due = static_cast<int8_t>(_shortened);  // most often the refused frame has lost one character
      if (_misses < Lost) {
        _misses++;
      }
    } else if (_place == Place::Any && _incoming[EndIndex] == LongEndByte && isFlagsByte(_incoming[FlagsIndex])) {
      _due = FrameSize + LongTailSize;  // no header can stand right behind it, but one behind its tail
      _misses = Unsure;
    }
    align(1);
  }
  return nullptr;
}

// A look begins with a header, and no pause was seen before it. If that happens at the same place within frames again
// and again, true frames begin there: the driver hands over in every pause, however short, but elsewhere only if its
// ring happens to be half full, at each place once in sixteen frames.
void Receiver::weigh() {
  if (_filled == 0 || _filled == FrameSize) {
    _distrust -= Doubt;
    return;
  }
  if (_place == Place::Any || _pauseAt != Nowhere || _filled < 2 || !isEndByte(_incoming[_filled - 1]) ||
      !isFlagsByte(_incoming[_filled - 2])) {
    return;
  }
  const bool samePlace = _rivalAt == _filled;
  _rivalAt = _filled;
  if (!samePlace) {
    return;
  }
  const uint32_t trust = _counters.frames - _distrust;
  if (trust < Doubt) {
    _pauseAt = _filled;
  } else {
    _distrust += trust > FullTrust ? trust - FullTrust + Doubt : Doubt;
  }
}

// Of 25 bytes: have they an end byte, and flags? Counted if not.
bool Receiver::endsLikeAFrame(const uint8_t *frame) {
  const uint8_t end = frame[EndIndex];
  if ((end & EndUnused) != 0 || !isEndByte(end)) {  // the first is quick, and tells most
    _counters.refusedByEnd++;
    return false;
  }
  if (!isFlagsByte(frame[FlagsIndex])) {
    _counters.refusedByFlags++;
    return false;
  }
  return true;
}

// At least 25 bytes are there, and a header is the first of them.
inline Receiver::Verdict Receiver::judge() {
  const uint8_t *const frame = _incoming;
  const bool nextKnown = _filled > FrameSize;
  if (!endsLikeAFrame(frame)) {
    return Verdict::Refuse;
  }
  if (!pauseSpeaksAgainst()) {
    if (nextKnown && ((frame[FrameSize] & HeaderMask) == HeaderByte || _pauseAt == FrameSize)) {
      return Verdict::Deliver;
    }
    if (_place != Place::Any && !mayBeShifted(nextKnown)) {
      return Verdict::Deliver;
    }
    if (!nextKnown) {
      return Verdict::Wait;
    }
  }
  _counters.refusedByExtra++;
  return Verdict::Refuse;
}

// A frame has no pause within it, but it seems to have one if loop() was blocked while it came in. Then all that came
// behind the pause was read in one look. That can happen to a frame behind the last one at any of its bytes, but hardly
// at the same one twice.
inline bool Receiver::pauseSpeaksAgainst() {
  if (!pauseInside()) {
    return false;
  }
  if (_place != Place::BehindFrame || _pauseAt >= FrameSize - FewBehind ||
      (_lookAt != _pauseAt && _lookAt != FrameSize)) {
    return true;
  }
  if (!headerAt(_pauseAt)) {
    return false;
  }
  const uint8_t number = static_cast<uint8_t>(_counters.frames);
  const bool again = _disputed == number;  // then true frames begin there
  _disputed = static_cast<uint8_t>(number + 1);
  return _pauseAt <= FewAhead || again || _counters.frames - _distrust < Doubt;
}

// Could these 25 bytes be the beginning of a frame into which a character was inserted? Then its own flags stand
// where the end byte is looked for, CH16 where the flags are, and its own end byte is `next`. Or could they be of a
// frame that has lost one? Then a byte from behind it stands where the end byte is looked for. Both are told by the
// last frame, from which this one should not differ in all of these at once.
inline bool Receiver::mayBeShifted(bool nextKnown) const {
  const uint8_t *const frame = _incoming;
  const uint8_t *const last = _complete;
  const uint8_t flags = frame[FlagsIndex];
  const uint8_t end = frame[EndIndex];
  const uint8_t next = frame[FrameSize];
  const bool newFlags = flags != last[FlagsIndex];
  const bool inserted = isFlagsByte(end) && (!nextKnown || (isEndByte(next) && sameKindOfEnd(next, end)));
  if (!_hasFrame || _misses >= Unsure) {
    return nextKnown && end != LongEndByte && inserted;
  }
  if (!sameKindOfEnd(end, last[EndIndex]) || (newFlags && flags == HeaderByte && _lookAt == FlagsIndex)) {
    return true;
  }
  if (end == LongEndByte) {
    return false;
  }
  if (nextKnown && _lookAt != FrameSize) {  // and it was read together with these
    const bool manyMore = _filled - FrameSize + _waiting > ManyMore && _pauses.shortPasses();
    return inserted || (end != TelemetryEndByte && (newFlags || manyMore));
  }
  return inserted && (isFlagsByte(last[FlagsIndex - 1]) ||
                      (newFlags && (nextKnown || frame[FlagsIndex - 1] != last[FlagsIndex - 1])));
}

const uint8_t *Receiver::deliver() {
  uint8_t *const frame = _incoming;
  _incoming = _complete;
  _complete = frame;
  _filled = static_cast<uint8_t>(_filled - FrameSize);
  for (uint8_t i = 0; i < _filled; i++) {
    _incoming[i] = frame[FrameSize + i];
  }
  _lookAt = static_cast<uint8_t>(_lookAt - FrameSize);
  if (_misses != 0) {
    _misses = 0;
    if (_pauseAt != 0) {
      _distrust = _counters.frames - LittleTrust;
    }
    if (_hasFrame) {
      _counters.resyncs++;
    }
  }
  _pauseAt = _pauseAt == FrameSize ? 0 : Nowhere;

  const uint8_t tail = frame[EndIndex] == LongEndByte ? LongTailSize : 0;
  _due = static_cast<int8_t>(tail);
  _shortened = static_cast<uint8_t>(FrameSize - 1 + tail);
  _place = Place::BehindFrame;
  _aligned = tail == 0;  // if the next byte is a header
  const uint32_t interval = _pauses.lastLook() - _frameTime;
  _frameTime += interval;
  if (_counters.frames > 1) {
    _counters.period += static_cast<uint32_t>(static_cast<int32_t>(interval - _counters.period) >> PeriodShift);
  } else {
    _counters.period = _counters.frames * interval;  // there is none before the second frame
  }
  _hasFrame = true;
  _counters.frames++;
  if ((frame[FlagsIndex] & (FlagLostFrame | FlagFailsafe)) != 0) {
    _counters.lostFrames += lostFrame(frame);
    _counters.failsafeFrames += failsafe(frame);
  }
  return frame;
}

// Lets the incoming frame begin with the likeliest header at or behind `from`; forgets what stands before it.
void Receiver::align(int from) {
  const uint8_t *const bytes = _incoming;
  const int filled = _filled;
  const int pause = _pauseAt;
  const bool headerBehindPause = pause < filled && bytes[pause] == HeaderByte;
  int due = _due;
  int misses = _misses;
  int start = from;
  Place place = Place::Any;
  for (; start < filled; start++) {
    if (misses < Lost && start > due + Late + LaterEachTime * misses) {
      due += _shortened;
      misses++;
    }
    if (bytes[start] != HeaderByte) {
      continue;
    }
    if (start + EndIndex < filled && !endsLikeAFrame(bytes + start)) {
      continue;  // nothing need be moved to see that
    }
    if (misses == 0 && start == due) {
      place = Place::BehindFrame;
      break;
    }
    if (headerBehindPause && pause >= start) {
      start = pause;
      place = Place::BehindPause;
      break;
    }
    if (misses == Lost) {
      break;
    }
    const int early = due - start;
    // If it is more than a character early, it must at least stand behind an end byte.
    if (early <= Early && (early <= 1 || start == 0 || (bytes[start - 1] & EndUnused) == 0)) {
      if (early > 0 && due < filled && bytes[due] == HeaderByte) {
        start = due;
      }
      place = Place::NearDue;
      break;
    }
  }
  _place = place;
  _misses = static_cast<uint8_t>(misses);
  _due = static_cast<int8_t>(due - start);
  _aligned = start < filled;
  if (start != 0) {
    _counters.skippedBytes += static_cast<unsigned>(start);
    _filled = static_cast<uint8_t>(filled - start);
    memmove(_incoming, _incoming + start, _filled);
    _lookAt = static_cast<uint8_t>(_lookAt - start);
    _pauseAt = pause >= start && pause < filled ? static_cast<uint8_t>(pause - start) : Nowhere;
  }
}

}  // namespace sbus
