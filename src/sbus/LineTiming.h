/// @file
/// Derives the gaps of a line from the times at which its port was polled.
#pragma once

#include <limits.h>
#include <stdint.h>

namespace sbus {

/// The slowest baud rate: a character lasts 255 us, the longest time that fits a uint8_t. S.Bus is faster.
constexpr unsigned long SlowestBaud = 47059;

/// The longest silence, in characters, that a port waits for before it hands over less than a burst: the RP2040's.
constexpr uint8_t IdleCharactersMax = 4;

/// A silence before a byte, or after one: how certain it is, and how long. Ask isCertain() for the one, isWide() for
/// the other.
enum class Silence : uint8_t {
  Unknown,  ///< perhaps none
  Late,     ///< doubtful: within a frame that is due, whose sender may stretch it
  Likely,   ///< doubtful: a gap, unless loop() was blocked
  Gap,      ///< certain: between two frames, or within one that its sender stretches
  Wide,     ///< certain, and longer than a sender is silent within a frame: between two frames
  Long,     ///< certain, and longer than any frame period: the next character may be anywhere in a frame
};

/// Returns true if the line was certainly silent.
constexpr bool isCertain(Silence silence) { return silence >= Silence::Gap; }

/// Returns true if it was certainly silent for longer than a sender is within a frame.
constexpr bool isWide(Silence silence) { return silence >= Silence::Wide; }

/// Ports hand bytes over late and in bursts: the Grasshopper's after 16 bytes, or when the line was idle for one
/// character. So the first byte that a poll finds began at most one burst before the last empty poll, and the previous
/// byte had arrived when it was found. Between the two the line was silent:
///
///     silence  >=  last empty poll - last poll that found bytes - one burst
///
/// A port that tells itself when the line was idle (the Grasshopper's) needs that only for long silences.
///
/// A sketch that polls only when bytes wait (serialEvent1(), an interrupt) has no empty polls. It is assumed to poll
/// late by at most the shortest time between two polls; if it is later, LineTiming reports a gap that does not exist.
///
/// Times are in us, and wrap after 71 minutes. Call all methods from the context that reads the port.
class LineTiming {
 public:
  /// Forgets all polls. `characterTime` in us: 120 at 100000 baud, 60 at 200000. `idleCharacters`, 0..21: how long the
  /// port waits for more bytes before it hands over less than a burst.
  void reset(uint32_t now, uint8_t characterTime, uint8_t idleCharacters) {
    _pollBefore = now;
    _lastPoll = now;
    _lastBytes = now - LongSilence;  // the line before the first character is unknown
    _shortestInterval = IntervalMax;
    _characterTime = characterTime;
    _idleCharacters = idleCharacters;
  }

  /// Returns a time before the end of the byte that `more` others follow in this poll. The previous poll did not find
  /// this byte: the port held it back, with those that follow it, and waited for each of them.
  uint32_t endedAfter(unsigned more) const {
    constexpr unsigned Each = IdleCharactersMax + 1;
    return _pollBefore - (IdleCharactersMax + (more < BurstMax ? more : BurstMax) * Each) * _characterTime;
  }

  /// Takes the time of a poll that found nothing.
  void empty(uint32_t now) {
    _shortestInterval = HasEmptyPolls;
    _lastPoll = now;
    if (now - _lastBytes > HalfClock) {
      _lastBytes = now - HalfClock;  // otherwise the silence would be short again once the clock has wrapped
    }
  }

  /// Takes the times of a poll that found `found` bytes, 1 or more: the port was asked at `asked`, and has answered by
  /// `now`. Others may have come in between. (Inlined: 57 cycles a frame less.)
  template <typename Format>
  __attribute__((always_inline)) Silence silenceBefore(unsigned found, uint32_t asked, uint32_t now) {
    const bool isKnown = hasEmptyPolls();
    const uint32_t us = (isKnown ? _lastPoll : now) - _lastBytes;
    const unsigned silence = ClockRuns && isKnown && static_cast<int32_t>(us) < 0 ? 0 : capped(us);
    notePoll(now);
    _lastPoll = asked;
    if (!isKnown) {
      return assumedBefore(found, silence);
    }
    if (silence <= burstTime<Format>(found)) {
      return Silence::Unknown;
    }
    return isLong(silence) ? Silence::Long : endsFrame(silence, found) ? Silence::Wide : Silence::Gap;
  }

  /// Notes a poll that found bytes, of a port that tells itself when the line was idle.
  void notePoll(uint32_t now) {
    _pollBefore = _lastPoll;
    _lastPoll = now;
    _lastBytes = now;
  }

  /// Returns for how long, in us, the line seems to have been silent before `found` bytes that were handed over at
  /// `handedOver`, if those before them were at `before`. Other work may delay a port's call unnoticed: then it was
  /// shorter.
  uint32_t silence(unsigned found, uint32_t handedOver, uint32_t before) const {
    const uint32_t us = handedOver - before;
    const uint32_t most = found * StretchedMax * _characterTime;
    return us > most ? us - most : 0;
  }

  /// Returns the time between the two newest polls that found bytes, us; at most UINT_MAX.
  unsigned interval() const { return capped(_lastPoll - _pollBefore); }

  uint8_t characterTime() const { return _characterTime; }  ///< us

  /// Returns the longest silence(), in us, that is no gap.
  uint32_t shortestGap() const { return uint32_t{Gap} * _characterTime; }

  static constexpr unsigned LongSilence = 50000;  ///< us: longer than any frame period
  static constexpr unsigned StopMax = 1500;       ///< us: no sender is silent for longer within a frame

  /// Takes a time at which the bytes that wait do not yet complete a frame.
  void incomplete(uint32_t now) { _lastPoll = now; }

  uint32_t lastPoll() const { return _lastPoll; }    ///< the time of the newest poll, or of incomplete()
  uint32_t lastBytes() const { return _lastBytes; }  ///< the time of the newest poll that found bytes

  /// False on an AVR, recognised by its 16-bit ints: while interrupts are off, its micros() counts 2 ms at most.
  static constexpr bool ClockRuns = UINT_MAX > UINT16_MAX;

  /// Returns true if foundTooFew() may be true: some polls have found nothing, so that the time of the previous poll is
  /// known (on an AVR JoinCheck asks, too, where none has), and the newest poll came later, by its interval(), than one
  /// character and a gap can explain. (Asked first: an AVR's sensor polls each 100 us while the end of a frame is
  /// expected.)
  bool mayHaveFoundTooFew(unsigned interval) const {
    return (!ClockRuns || hasEmptyPolls()) && interval > unsigned{_characterTime} * (Gap + 2);
  }

  /// Returns true if the newest poll, `interval` us after the one before, must have found more than its `found` bytes.
  /// The first of them belong to a frame that lacked `missing` bytes, 0 if none was incomplete. In a frame the
  /// characters follow each other, and a frame is complete at most one `period`, us, after the previous frame. Call it
  /// only if mayHaveFoundTooFew().
  template <typename Format>
  bool foundTooFew(unsigned interval, int found, int missing, uint32_t period, bool isStretched) const {
    const unsigned handedOver = static_cast<unsigned>(found) + (_idleCharacters != 0 ? BurstMax : 0);
    const unsigned most = isStretched ? handedOver * StretchedMax + _idleCharacters + Gap : inTime<Format>(handedOver);
    const unsigned enough = most * _characterTime;
    unsigned late = interval;
    if (late <= enough || (!ClockRuns && (found >= missing || !hasEmptyPolls()))) {
      return false;
    }
    late -= enough;
    for (int whole = missing; ClockRuns && whole <= found; whole += Format::Size) {
      if (late <= period) {
        return false;
      }
      late -= static_cast<unsigned>(period);
    }
    return true;
  }

  /// Returns the time of the poll before the newest one that found bytes.
  uint32_t pollBefore() const { return _pollBefore; }

  /// Returns what the empty poll just taken proves about the line after the last byte: Unknown, Gap or Wide.
  template <typename Format>
  Silence silenceAfter() const {
    const unsigned silence = capped(_lastPoll - _lastBytes);
    return silence <= burstTime<Format>(BurstMax) ? Silence::Unknown
           : endsFrame(silence, BurstMax)         ? Silence::Wide
                                                  : Silence::Gap;
  }

 private:
  static constexpr uint16_t HasEmptyPolls = UINT16_MAX;
  static constexpr uint32_t HalfClock = INT32_MAX;   // us: a Cortex-M0+ compares with the sign
  static constexpr unsigned IntervalMax = 8000;      // us between polls; above it no gap is certain
  static constexpr unsigned AssumedInterval = 4000;  // us between polls, while none was shorter than IntervalMax
  static constexpr unsigned BurstMax = 16;           // characters: the most that a port hands over at once
  static constexpr unsigned Gap = 2;                 // characters

  // Some senders stretch a frame: 240 us from one character to the next, or silences of half a millisecond
  // (extras/docs/receiver.md).
  static constexpr unsigned StretchedMax = 2;  // characters' time for each

  bool hasEmptyPolls() const { return _shortestInterval == HasEmptyPolls; }

  // 16 bits on an AVR: a longer time counts as 65 ms, which saves 42 bytes of flash.
  static unsigned capped(uint32_t us) { return us < UINT_MAX ? static_cast<unsigned>(us) : UINT_MAX; }

  // Returns true if the line may have been open: once closed, it may be anywhere in a frame. (Two frame periods instead
  // of 50 ms: a tenth fewer wrong frames where gaps are not seen, for 32 bytes on a Cortex-M0+ and 106 on an AVR.)
  static bool isLong(unsigned silence) { return silence >= LongSilence; }

  // Returns how many of `found` characters the port may have held back before it handed them over.
  unsigned burst(unsigned found) const { return _idleCharacters == 0 ? 1 : found < BurstMax ? found : BurstMax; }

  // Returns true if no sender is silent for so long within a frame.
  bool endsFrame(unsigned silence, unsigned found) const {
    return silence > (burst(found) * StretchedMax + _idleCharacters) * _characterTime + StopMax;
  }

  // Returns within how many characters' time these follow each other and are handed over, plus a gap.
  template <typename Format>
  unsigned inTime(unsigned found) const {
    return Format::spread(found) + _idleCharacters + Gap;
  }

  // Returns the longest time from the start of the first of these bytes until it is handed over, plus a gap.
  template <typename Format>
  unsigned burstTime(unsigned found) const {
    const unsigned characters = _idleCharacters == 0 ? 2 : inTime<Format>(found);
    return (characters < Format::SpreadMax ? characters : Format::SpreadMax) * _characterTime;
  }

  // For a sketch that polls only when bytes wait.
  __attribute__((always_inline)) Silence assumedBefore(unsigned found, unsigned interval) {
    unsigned period = AssumedInterval;
    Silence gap = Silence::Likely;
    if (interval < _shortestInterval) {
      _shortestInterval = static_cast<uint16_t>(interval);
      return Silence::Unknown;
    }
    if (_shortestInterval < IntervalMax) {
      period = _shortestInterval;
      gap = Silence::Gap;
      _shortestInterval = static_cast<uint16_t>(period + period / 32);  // follows a loop() that becomes slower
    }
    unsigned burst = found;
    if (found > BurstMax) {
      burst = BurstMax;
      if ((found - BurstMax) * _characterTime > period) {
        return Silence::Unknown;  // more than a burst and a period bring: loop() was blocked
      }
    }
    if (interval <= period + (burst + IdleCharactersMax + Gap) * _characterTime) {
      return Silence::Unknown;
    }
    return isLong(interval - period) ? Silence::Long : gap;
  }

  uint8_t _characterTime;      // us
  uint8_t _idleCharacters;     // 0: the port hands over each character at once
  uint16_t _shortestInterval;  // us between polls; HasEmptyPolls: not needed, as some polls were empty
  uint32_t _pollBefore;        // us
  uint32_t _lastPoll;          // us
  uint32_t _lastBytes;         // us: the last poll that found bytes, at most HalfClock before the last poll
};

}  // namespace sbus
