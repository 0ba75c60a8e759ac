/// @file
/// Tells the gaps of a line from the times at which its port was asked for bytes.
#pragma once

#include <limits.h>
#include <stdint.h>

namespace sbus {

/// Here a character lasts 255 us, the longest that LineTiming knows. S.Bus is faster.
constexpr unsigned long SlowestBaud = 47059;

/// The RP2040's port waits for so long a silence, in characters, before it hands over what it has: longer than others.
constexpr uint8_t MostIdleCharacters = 4;

/// What stood before the bytes that a call has found.
enum class Silence : uint8_t {
  Unknown,  ///< there may have been a gap or not
  Likely,   ///< there was a gap, unless loop() was blocked
  Gap,      ///< longer than two characters, for certain
  Long,     ///< longer than any frame period: says nothing about the next character's place in a frame
};

/// A port hands bytes over late and in bursts: the Grasshopper's when 16 have come, or when the line was idle for one
/// character. So the first of the bytes that a call finds began no earlier than one burst before the last call that
/// found none, and the last byte before them had come when it was found. What lies between is silence:
///
///     silence  >=  last empty call - last call that found bytes - one burst
///
/// A sketch that calls only when bytes wait (serialEvent1(), an interrupt) has no empty calls. There a call is taken to
/// be late by the shortest time between two calls: if it is later, a gap is reported where there is none.
///
/// Times are in us, and wrap after 71 minutes. All calls come from the context that reads the port.
class LineTiming {
 public:
  /// Forgets what was seen. `characterTime` in us: 120 at 100000 baud, 60 at 200000. `idleCharacters`: so long a port
  /// waits for more before it hands over less than a full burst, 0..4.
  void reset(uint32_t now, uint8_t characterTime, uint8_t idleCharacters) {
    _callBefore = now;
    _lastCall = now;
    _lastBytes = now - LongSilence;  // what came before the first character is unknown
    _shortest = LongestInterval;
    _characterTime = characterTime;
    _idleCharacters = idleCharacters;
  }

  /// The byte found last but `behind` others ended after this time: the call before had not found it, because the port
  /// had not handed it over yet, together with those behind it, and waited for each of them.
  uint32_t endedAfter(unsigned behind) const {
    constexpr unsigned Each = MostIdleCharacters + 1;
    return _callBefore - (MostIdleCharacters + (behind < LongestBurst ? behind : LongestBurst) * Each) * _characterTime;
  }

  /// A call found nothing.
  void empty(uint32_t now) {
    _shortest = HasEmptyCalls;
    _lastCall = now;
    if (now - _lastBytes > HalfClock) {
      _lastBytes = now - HalfClock;  // else the silence would be short again once the clock has wrapped
    }
  }

  /// A call found `found` bytes, 1 or more. (In line: 57 cycles a frame less.)
  template <typename Format>
  __attribute__((always_inline)) Silence silenceBefore(unsigned found, uint32_t now) {
    const bool isKnown = _shortest == HasEmptyCalls;
    const unsigned silence = capped((isKnown ? _lastCall : now) - _lastBytes);
    _callBefore = _lastCall;
    _lastCall = now;
    _lastBytes = now;
    if (!isKnown) {
      return assumedBefore(found, silence);
    }
    if (silence <= burstTime<Format>(found)) {
      return Silence::Unknown;
    }
    return silence < LongSilence ? Silence::Gap : Silence::Long;
  }

  /// True if the empty call just made shows that the line has been silent since the last byte.
  template <typename Format>
  bool isSilent() const {
    return capped(_lastCall - _lastBytes) > burstTime<Format>(LongestBurst);
  }

 private:
  static constexpr uint16_t HasEmptyCalls = UINT16_MAX;
  static constexpr uint32_t HalfClock = INT32_MAX;   // us: a Cortex-M0+ compares with the sign
  static constexpr unsigned LongSilence = 50000;     // us
  static constexpr unsigned LongestInterval = 8000;  // us from call to call: with slower ones nothing is sure
  static constexpr unsigned AssumedInterval = 4000;  // us from call to call, while there is none shorter than that
  static constexpr unsigned LongestBurst = 16;       // characters that a port hands over at once
  static constexpr unsigned Gap = 2;                 // characters

  // What an AVR takes at once: 16 bits, 65 ms, which are as long as any more. 42 bytes less there.
  static unsigned capped(uint32_t us) { return us < UINT_MAX ? static_cast<unsigned>(us) : UINT_MAX; }

  // The longest time from the beginning of the first of these bytes until it is handed over, and a gap's.
  template <typename Format>
  unsigned burstTime(unsigned found) const {
    const unsigned characters = Format::spread(found) + _idleCharacters + Gap;
    return (characters < Format::LongestSpread ? characters : Format::LongestSpread) * _characterTime;
  }

  // Of a sketch that calls only when bytes wait.
  __attribute__((always_inline)) Silence assumedBefore(unsigned found, unsigned interval) {
    unsigned period = AssumedInterval;
    Silence gap = Silence::Likely;
    if (interval < _shortest) {
      _shortest = static_cast<uint16_t>(interval);
      return Silence::Unknown;
    }
    if (_shortest < LongestInterval) {
      period = _shortest;
      gap = Silence::Gap;
      _shortest = static_cast<uint16_t>(period + period / 32);  // loop() may become slower
    }
    unsigned burst = found;
    if (found > LongestBurst) {
      burst = LongestBurst;
      if ((found - LongestBurst) * _characterTime > period) {
        return Silence::Unknown;  // more than a burst and a period bring: loop() was blocked, and the time says nothing
      }
    }
    if (interval <= period + (burst + MostIdleCharacters + Gap) * _characterTime) {
      return Silence::Unknown;
    }
    return interval < LongSilence + period ? gap : Silence::Long;
  }

  uint8_t _characterTime;  // us
  uint8_t _idleCharacters;
  uint16_t _shortest;    // us from call to call; HasEmptyCalls: some were empty, and it is not needed
  uint32_t _callBefore;  // us
  uint32_t _lastCall;    // us
  uint32_t _lastBytes;   // us: the last call that found bytes, no earlier than HalfClock before the last call
};

}  // namespace sbus
