/// @file
/// The earliest start of the next frame, with which a sensor's answers must not collide.
#pragma once

#include <stdint.h>

#include "SlotSchedule.h"

namespace sbus {

/// Keeps the shortest interval between the frames of the last 1024 to 2048. An answer that destroys a frame makes an
/// interval longer, never shorter, so the shortest interval comes from frames that answers cannot have damaged. Before
/// the first answer, and after an answer that collided or cost a frame, it only listens for some frames: 16, then twice
/// as many each time, up to 1024. The number halves after 64 frames with good answers.
///
/// Times are in us and wrap. The context that reads the port calls it.
class FrameInterval {
 public:
  /// Forgets all frames.
  void reset() {
    _shortest = Unknown;
    _candidate = Unknown;
    _frames = 0;
    _good = 0;
    _isKnown = false;
    _pause = FirstPause;
    _left = FirstPause;
  }

  /// Takes the end of a frame, and what became of the answers since the previous frame.
  void frame(uint32_t end, SlotSchedule::Outcome outcome) {
    const uint32_t interval = end - _end;
    _end = end;
    if (!_isKnown) {
      _isKnown = true;
      return;
    }
    if (interval >= Unknown) {  // another receiver may send now
      reset();
      _isKnown = true;
      return;
    }
    const uint16_t us = static_cast<uint16_t>(interval);
    const bool isLost = outcome == SlotSchedule::Outcome::Fine && us > _shortest && us - _shortest > _shortest / 2;
    if (isLost || outcome == SlotSchedule::Outcome::Collided) {
      listen();
    } else if (_left > 0) {
      _left--;
    } else if (outcome == SlotSchedule::Outcome::Fine && ++_good == ManyGood) {
      _good = 0;
      _pause = _pause > FirstPause ? static_cast<uint16_t>(_pause / 2) : FirstPause;
    }
    _shortest = us < _shortest ? us : _shortest;
    _candidate = us < _candidate ? us : _candidate;
    if (++_frames == Memory) {  // an interval that no longer occurs is forgotten
      _shortest = _candidate;
      _candidate = Unknown;
      _frames = 0;
    }
  }

  /// Takes a frame that ended between `earliest` and `latest`. It counts only if it certainly came early. The next
  /// interval is not known.
  void endedBetween(uint32_t earliest, uint32_t latest) {
    if (_isKnown && latest - _end < _shortest) {
      const uint32_t us = earliest - _end;
      _shortest = us < _shortest ? static_cast<uint16_t>(us) : uint16_t{0};
      _candidate = _shortest < _candidate ? _shortest : _candidate;
    }
    missed();
  }

  /// Takes a frame with an unknown end: the next interval is unknown, too.
  void missed() { _isKnown = false; }

  /// Returns the shortest interval from the end of a frame to the end of the next one, us; 0 while it only listens.
  uint16_t shortest() const { return _left > 0 ? 0 : _shortest; }

 private:
  static constexpr uint16_t Unknown = UINT16_MAX;  // us
  static constexpr uint16_t Memory = 1024;         // frames
  static constexpr uint16_t FirstPause = 16;       // frames
  static constexpr uint8_t ManyGood = 64;          // frames

  void listen() {
    _good = 0;
    _left = _pause;
    _pause = _pause < Memory ? static_cast<uint16_t>(2 * _pause) : Memory;
  }

  uint32_t _end = 0;
  uint16_t _shortest = Unknown;   // us
  uint16_t _candidate = Unknown;  // us, of the newest frames
  uint16_t _frames = 0;           // these
  uint8_t _good = 0;              // frames with answers, and nothing wrong
  uint16_t _pause = FirstPause;   // frames: the next pause
  uint16_t _left = FirstPause;    // frames of this one
  bool _isKnown = false;          // the end of the previous frame
};

}  // namespace sbus
