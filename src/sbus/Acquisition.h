/// @file
/// Does a line carry frames of this size at all?
#pragma once

#include <stdint.h>

#include "Rule.h"

namespace sbus {

/// Counts the characters from gap to gap: FrSky's frames of 24 channels have 36. All calls come from the context that
/// reads the port.
template <typename Format>
class Acquisition {
 public:
  /// Forgets what was seen.
  void reset() {
    _doubts = 0;
    _group = 0;
    forget();
  }

  /// The line was silent for so long that the next character is as good as its first; or nothing is known of the
  /// characters before that one.
  void forget(bool isSilent = false) { _run = _lastRun = isSilent ? 0 : Unseen; }

  /// `found` characters have come.
  void characters(unsigned found) {
    _run = static_cast<uint8_t>(static_cast<int>(found) < Unseen - _run ? _run + found : Unseen);
  }

  /// A gap stands before the next character; `waiting` of those before it belong to no frame yet. Returns true if a
  /// frame of the other size has just ended. If the line's variant is not known either (`isVariantOpen`), it forbids frames
  /// until one of the right size has come, or eight gaps.
  bool gap(int waiting, bool isVariantOpen) {
    if (_run == 0) {
      return false;  // it is known already
    }
    const bool isOther = _run == Format::OtherSize;
    if (isOther) {
      _doubts = isVariantOpen ? Memory : _doubts;
    } else if (_run == Format::Size) {
      _doubts = 0;
    } else if (waiting >= Format::Size && _run > waiting + 1 && _run <= Format::OtherSize) {
      // What waits may be the end of a frame of the other size that lost characters. (One before it may be a stray.)
      _doubts = _doubts == 0 ? 1 : _doubts;
    } else if (_doubts > 0) {
      _doubts--;
    }
    _lastRun = _lastRun == 0 ? Unseen : _run;  // the silence before the first character proves nothing
    _run = 0;
    return isOther;
  }

  /// How many characters stood between the two newest gaps; 255 if that is not known.
  int lastRun() const { return _lastRun; }

  /// A frame may stand here: there are no doubts, and it stands at a gap if the line shows any, or `isFirst` on it.
  bool allows(bool isAtGap, bool isFirst) const {
    const bool showsGaps = _run < (_lastRun == 0 ? 2 * Format::Size : Unseen);
    return (_doubts == 0 || !holds(Rule::other)) && (isAtGap || !showsGaps || isFirst || !holds(Rule::first));
  }

  /// A frame with this end byte has the ID of a telemetry slot behind it. True if the one before announced the group
  /// before: for one such ID alone 8 of 800000 frames of 24 channels are believed, for two 5.
  bool isInTurn(uint8_t end) {
    const uint8_t before = _group;
    _group = static_cast<uint8_t>(end + 0x10) & 0x3F;
    return end == before;
  }

 private:
  static constexpr uint8_t Memory = 8;      // gaps
  static constexpr int Unseen = UINT8_MAX;  // characters: a line without a gap in them shows none

  uint8_t _doubts;   // gaps until frames are believed again
  uint8_t _run;      // characters since a gap
  uint8_t _lastRun;  // characters between the two gaps before
  uint8_t _group;    // end byte of the next frame, if it comes in turn
};

}  // namespace sbus
