/// @file
/// Tells the pauses of a line from the times at which its bytes were read.
#pragma once

#include <stdint.h>

namespace sbus {

/// Here a character lasts 255 us, the longest that Pauses knows. S.Bus is faster.
constexpr unsigned long SlowestBaud = 47059;

/// A port hands bytes over late and in bursts: on the Grasshopper when 16 have come, or when the line has been idle for
/// one character. No port that begin() opens has longer ones (SBusPort.h). A loop() then polls it once a loop period.
/// So without a pause on the line the time between two polls that find bytes is no longer than
///
///     a burst lasts          +  a loop period:  if it is, there was a pause; nor longer than
///     the bytes found last   +  a loop period:  if it is, there was a pause, too.
///
/// Nobody tells the loop period. The shortest time between two polls is taken for it.
///
/// Times are in us, and wrap after 71 minutes. All calls come from the context that reads the port.
class Pauses {
 public:
  /// Forgets what was seen. `characterTime` in us: 120 at 100000 baud, 60 at 200000.
  void reset(uint32_t now, uint8_t characterTime) {
    _lastPoll = now;
    _loopPeriod = LongestPeriod + 1;
    _characterTime = characterTime;
  }

  /// When the last poll was that found bytes, or reset().
  uint32_t lastPoll() const { return _lastPoll; }

  /// us since lastPoll(). 0: it is still the same poll.
  uint32_t quiet(uint32_t now) const { return now - _lastPoll; }

  /// False while no polls have come fast enough to tell the loop period: loop() is slow, or the port hands over whole
  /// frames. What looks like a pause may be none then.
  bool areSure() const { return _loopPeriod <= LongestPeriod; }

  /// Call it for each poll that finds bytes: `found` of them, 1 or more, after `quiet` us, 1 or more. True if a pause
  /// came before the first of them.
  bool pauseBefore(unsigned found, uint32_t quiet) {
    unsigned period = _loopPeriod;
    _lastPoll += quiet;
    if (quiet < period) {
      _loopPeriod = static_cast<uint16_t>(quiet);
      return false;
    }
    if (areSure()) {
      _loopPeriod = static_cast<uint16_t>(period + period / Forgetting);
    } else {
      period = AssumedPeriod;
    }
    const unsigned burst = burstTime();
    const unsigned busy = found * _characterTime;
    if (quiet - period > burst) {
      return busy <= burst + period;  // more than that was found: loop() was blocked, and the time says nothing
    }
    return quiet - period > busy + (burst + period) / Tolerance;
  }

  /// True if the line was idle after the bytes found: the poll came later than they take, and they are not as many as a
  /// port hands over while the line is busy.
  bool idleAfter(unsigned found, uint32_t quiet) const {
    return found % HalfBurst != 0 && quiet >= (found + 1) * _characterTime;
  }

 private:
  static constexpr unsigned AssumedPeriod = 4000;  // us: of a loop() whose period is not known
  static constexpr unsigned BurstSize = 17;        // characters: 16 of the Grasshopper's burst, and the idle one
  static constexpr unsigned HalfBurst = 8;         // characters: ports hand over 8 or 16 of them
  static constexpr unsigned Tolerance = 8;         // loop periods differ by an eighth, and some characters may be lost
  static constexpr unsigned LongestPeriod = 8000;  // us: some more than the 5 ms that DecodeSBus.h asks for
  static constexpr unsigned Forgetting = 32;       // loop() may become slower: the period grows by 3 % a poll

  unsigned burstTime() const { return BurstSize * _characterTime; }

  uint8_t _characterTime;  // us
  uint16_t _loopPeriod;    // us
  uint32_t _lastPoll;      // us
};

}  // namespace sbus
