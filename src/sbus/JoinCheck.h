/// @file
/// Decides whether a frame may consist of parts of several, where the clock stops while interrupts are off.
#pragma once

#include <stdint.h>

namespace sbus {

/// While interrupts are off a UART keeps a few characters and loses the others, and an AVR's clock stops, too. What is
/// left of two frames may look like one of `Size` characters. It has two marks:
/// - A poll has found three characters or more, as many as the UART keeps. If loop() polls often, no other frame has
///   this mark.
/// - Its parts are a frame period apart, so it takes longer than a frame. So may a frame that comes slowly because
///   loop() polls seldom.
///
/// So frames with these marks are doubted only for a while after a poll that has lost characters. Polls that come too
/// seldom show nothing: isUnplaced().
///
/// `IsUsed` is false where the clock runs on: there FrameFinder::checkFound() sees the lost time, and this class is
/// empty.
template <int Size, bool IsUsed>
class JoinCheck {
 public:
  /// Forgets everything.
  void reset() {
    _interval = 0;
    _isCrowded = _isTrusted = false;
    _doubt = _patience = 0;
  }

  /// The port tells what it has lost: doubts no frame, until reset().
  void trustPort() { _isTrusted = true; }

  /// Takes a poll that found `found` characters, `interval` us after the poll at `before`, us. The first of them belong
  /// to a frame of which `filled` have come; 0: they begin one. `characterTime` in us.
  void poll(unsigned found, unsigned filled, uint32_t before, unsigned interval, uint8_t characterTime,
            bool isStretched) {
    if (_isTrusted) {
      return;
    }
    _interval = found < FullPort ? interval : 0;
    _isCrowded = (filled != 0 && _isCrowded) || found > MostAtOnce;
    if (filled == 0) {
      _after = static_cast<uint16_t>(before);
    }
    if (hasLost(found, filled, interval, characterTime, isStretched)) {
      _doubt = DoubtMax;
    }
  }

  /// Returns true if the poll that brings a frame's end came so late that the frame may lie anywhere in the time before
  /// it: then only a frame directly behind another, or behind a frame's number of characters, is one.
  bool isUnplaced() const { return _interval > IntervalMax; }

  /// Returns true if the frame that was complete at `time`, us, may be joined. `usual`: how long its sender takes for a
  /// frame, us. `isInSync`: it follows an aligned frame directly. Call it once for each frame.
  bool isJoined(uint32_t time, uint16_t usual, bool isInSync) {
    if (!_isCrowded) {
      _patience = PatienceMax;
      return false;
    }
    if (_doubt == 0) {
      return false;
    }
    _doubt--;
    if (_patience != 0) {
      _patience--;
      return true;
    }
    const uint16_t took = static_cast<uint16_t>(static_cast<uint16_t>(time) - _after);
    return took > usual + (isInSync ? LateInSync : Late);
  }

 private:
  static constexpr unsigned MostAtOnce = 2;  // characters: an AVR's UART keeps 3
  static constexpr unsigned FullPort = 60;   // characters: an AVR's port may have lost the next, and holds whole frames
  static constexpr unsigned Dropped = 3;     // characters that the line may have lost, of a frame
  static constexpr unsigned Paused = 600;    // us: a silence within a frame
  static constexpr unsigned CountedMax = 2100;   // us: an AVR's clock counts 2 ms of a stop at most
  static constexpr unsigned SilenceMax = 13000;  // us between frames: an R7008SB has 12 ms
  static constexpr unsigned IntervalMax = 8000;  // us between polls, as LineTiming has it
  static constexpr uint8_t DoubtMax = 100;       // crowded frames
  static constexpr uint8_t PatienceMax = 8;      // crowded frames in a row: then loop() polls seldom
  static constexpr uint16_t Late = 3800;         // us: parts of two frames are a period apart, 4 ms or more
  static constexpr uint16_t LateInSync = 10000;  // us: two polls of a loop() of 5 ms

  // Returns true if more characters must have come in the time, even if the sender pauses, and the line has lost some.
  static bool hasLost(unsigned found, unsigned filled, unsigned interval, uint8_t characterTime, bool isStretched) {
    const bool mayStretch = found < Size && (isStretched || interval > CountedMax);
    unsigned most = found * characterTime * (mayStretch ? 2 : 1) + Paused;
    if (interval <= most) {  // as nearly always
      return false;
    }
    for (unsigned whole = filled == 0 ? 0 : Size - filled; whole <= found + Dropped; whole += Size) {
      most += SilenceMax;
    }
    return interval > most;
  }

  unsigned _interval;  // us: the newest poll came so long after the one before it; 0 if the port was full
  bool _isTrusted;     // the port tells what it has lost
  uint16_t _after;     // us: the incoming frame had not begun then
  bool _isCrowded;     // one of its polls found more than MostAtOnce
  uint8_t _doubt;      // crowded frames until all are believed
  uint8_t _patience;   // crowded frames until time alone decides
};

/// Where the clock runs on.
template <int Size>
class JoinCheck<Size, false> {
 public:
  void trustPort() {}                                                         ///< does nothing
  void reset() {}                                                             ///< does nothing
  void poll(unsigned, unsigned, uint32_t, unsigned, uint8_t, bool) {}         ///< does nothing
  static constexpr bool isUnplaced() { return false; }                        ///< returns false
  static constexpr bool isJoined(uint32_t, uint16_t, bool) { return false; }  ///< returns false
};

}  // namespace sbus
