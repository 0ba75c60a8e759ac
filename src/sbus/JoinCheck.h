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
    _isUnplaced = _isCrowded = _isTrusted = false;
    _doubt = _patience = 0;
  }

  /// The port tells what it has lost: doubts no frame, until reset().
  void trustPort() { _isTrusted = true; }

  /// Takes a poll that found `found` characters, after a poll at `before`, us. `begins`: no frame is incomplete.
  void poll(unsigned found, bool begins, uint16_t before) {
    _isUnplaced = false;
    if (begins) {
      _after = before;
      _isCrowded = false;
    }
    if (found > MostAtOnce) {
      _isCrowded = true;
    }
  }

  /// Takes the time between the two polls, us, if it was 0.7 ms or more. `missing`: how many characters the incomplete
  /// frame lacked before; 0: none was incomplete. `characterTime` in us. Returns true if the port has lost some of
  /// them.
  bool late(unsigned interval, unsigned found, unsigned missing, uint8_t characterTime, bool isStretched) {
    unsigned most = found * characterTime;  // even if the sender pauses
    if (found < Size && (isStretched || interval > CountedMax)) {
      most *= 2;
    }
    most += Paused;
    if (interval <= most) {  // as nearly always
      return false;
    }
    if (!_isTrusted) {
      _isUnplaced = interval > IntervalMax && found < FullPort;
      for (unsigned whole = missing; whole <= found + Dropped; whole += Size) {
        most += SilenceMax;
      }
      if (interval > most) {
        _doubt = DoubtMax;
      }
    }
    return found < missing;
  }

  /// Returns true if the poll that brings a frame's end came so late that the frame may lie anywhere in the time before
  /// it: then only a frame directly behind another, or behind a frame's number of characters, is one.
  bool isUnplaced() const { return _isUnplaced; }

  /// Returns true if the frame that was complete at `time`, us, may be joined. `isInSync`: it follows an aligned frame
  /// directly. Call it once for each frame.
  bool isJoined(uint16_t time, uint8_t characterTime, bool isStretched, bool isInSync) {
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
    unsigned usual = unsigned{Size} * characterTime;
    if (isStretched) {
      usual *= 2;
    }
    return static_cast<uint16_t>(time - _after) > usual + (isInSync ? LateInSync : Late);
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

  bool _isUnplaced;   // see isUnplaced()
  bool _isTrusted;    // the port tells what it has lost
  uint16_t _after;    // us: the incoming frame had not begun then
  bool _isCrowded;    // one of its polls found more than MostAtOnce
  uint8_t _doubt;     // crowded frames until all are believed
  uint8_t _patience;  // crowded frames until time alone decides
};

/// Where the clock runs on.
template <int Size>
class JoinCheck<Size, false> {
 public:
  void trustPort() {}                                                                        ///< does nothing
  void reset() {}                                                                            ///< does nothing
  void poll(unsigned, bool, uint16_t) {}                                                     ///< does nothing
  static constexpr bool late(unsigned, unsigned, unsigned, uint8_t, bool) { return false; }  ///< returns false
  static constexpr bool isUnplaced() { return false; }                                       ///< returns false
  static constexpr bool isJoined(uint16_t, uint8_t, bool, bool) { return false; }            ///< returns false
};

}  // namespace sbus
