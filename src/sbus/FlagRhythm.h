/// @file
/// Recognises a lost-frame flag that comes and goes at a steady rhythm: the radio sends packets more seldom than the
/// receiver frames. Frames are lost to distance and disturbance at random.
#pragma once

#include <stdint.h>

namespace sbus {

/// Takes the lost-frame flag of each frame. Only a program that diagnoses a line needs it: 10 bytes of RAM.
class FlagRhythm {
 public:
  /// As many runs of frames with or without the flag; of a line that loses every second frame at random, one in 4000
  /// has such a rhythm in its first 27 runs, and others hardly ever.
  static constexpr uint8_t RunsMin = 16;

  /// Takes the next frame's flag.
  void put(bool isLost) {
    if (isLost != _isLost) {
      end();
      _isLost = isLost;
      _run = 0;
    }
    _run = static_cast<uint8_t>(_run < UINT8_MAX ? _run + 1 : _run);
  }

  /// Returns true if of the runs, one in 16 at most differs by more than a frame from the previous one of its kind.
  bool isSteady() const { return _runs >= RunsMin && _odd <= _runs / 16; }

 private:
  void end() {
    const uint8_t before = _before[_isLost];
    if (before != 0 && _runs < UINT16_MAX) {
      _runs++;
      _odd = static_cast<uint16_t>(_odd + (_run > before + 1 || before > _run + 1));
    }
    _before[_isLost] = _isFirst ? 0 : _run;  // the first one may have begun before
    _isFirst = false;
  }

  uint8_t _run = 0;
  uint8_t _before[2] = {};  // the length of the newest run without the flag, and with it; 0: none yet
  bool _isLost = false;
  bool _isFirst = true;
  uint16_t _runs = 0;  // that were compared
  uint16_t _odd = 0;   // of these
};

}  // namespace sbus
