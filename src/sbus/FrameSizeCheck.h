/// @file
/// Decides whether a line carries frames of this size at all.
#pragma once

#include <stdint.h>

namespace sbus {

/// Counts the characters between two gaps: FrSky's frames of 24 channels have 36. Call all methods from the context
/// that reads the port.
template <typename Format>
class FrameSizeCheck {
 public:
  /// Forgets everything.
  void reset() {
    _gapsUntilTrusted = 0;
    _group = 0;
    _stretched = 0;
    forget();
  }

  /// Forgets the characters since the last gap. `isSilent`: after a long silence the next character counts as the
  /// line's first.
  void forget(bool isSilent = false) { _sinceGap = _betweenGaps = isSilent ? 0 : Unseen; }

  /// Counts `found` characters.
  void characters(unsigned found) {
    _sinceGap = static_cast<uint8_t>(static_cast<int>(found) < Unseen - _sinceGap ? _sinceGap + found : Unseen);
  }

  /// Takes a gap before the next character; `waiting` of the characters before it belong to no frame yet. Returns true
  /// if a frame of the other size has just ended. If the line variant is unknown (`isVariantOpen`), this forbids frames
  /// until one of the right size, or eight gaps, have come.
  bool gap(int waiting, bool isVariantOpen) {
    if (_sinceGap == 0) {
      return false;  // this gap was taken before
    }
    const bool isOther = _sinceGap == Format::OtherSize;
    if (isOther) {
      _gapsUntilTrusted = isVariantOpen ? Memory : _gapsUntilTrusted;
    } else if (_sinceGap == Format::Size) {
      _gapsUntilTrusted = 0;
      _stretched = static_cast<uint8_t>(_stretched - (_stretched != 0));
    } else if (waiting >= Format::Size && _sinceGap > waiting + 1 && _sinceGap <= Format::OtherSize) {
      // Possibly the tail of a damaged frame of the other size, after a stray character.
      _gapsUntilTrusted = _gapsUntilTrusted == 0 ? 1 : _gapsUntilTrusted;
    } else if (_gapsUntilTrusted > 0) {
      _gapsUntilTrusted--;
    }
    _betweenGaps = _betweenGaps == 0 ? Unseen : _sinceGap;  // the line may have been joined within a frame
    _sinceGap = 0;
    return isOther;
  }

  /// Takes a frame with a gap inside: two of them, with at most two others in between, show that the sender stretches
  /// frames, until a hundred have come that have none.
  void stretchedFrame() { _stretched = _stretched == 0 ? NotYet : 100; }

  /// Returns true if the sender stretches frames.
  bool isStretched() const { return _stretched > NotYet; }

  /// Returns true if a frame's number of characters has come since the last gap: if another gap follows, the two prove
  /// each other, even if the port called late.
  bool isFrame() const { return _sinceGap == Format::Size || (_sinceGap > Format::Size && _sinceGap == _betweenGaps); }

  /// Returns how many characters came between the two newest gaps; 255 if unknown.
  int betweenGaps() const { return _betweenGaps; }

  /// Returns true if a frame may begin here: frames are not forbidden, and the frame begins at a gap, is the first on
  /// the line (`isFirst`), or the line shows no gaps.
  bool allows(bool isAtGap, bool isFirst) const {
    const bool hidesGaps = !showsGaps();  // in the condition it would cost 44 bytes on a Cortex-M0+
    return !isDoubted() && (isAtGap || hidesGaps || isFirst);
  }

  /// Takes the end byte of a frame that a slot's ID follows. Returns true if the previous frame announced the previous
  /// group. With sticks at rest, frames of 24 channels may look like an S.BUS2 frame and an ID, but not in turn:
  /// without this rule 2141 of 10000 of these frames are accepted (`make impairment WITHOUT=turn`).
  bool isInTurn(uint8_t end) {
    const uint8_t before = _group;
    _group = static_cast<uint8_t>(end + 0x10) & 0x3F;
    return end == before;
  }

 private:
  static constexpr uint8_t Memory = 8;      // gaps
  static constexpr uint8_t NotYet = 3;      // frames
  static constexpr int Unseen = UINT8_MAX;  // characters; a line without a gap in them shows no gaps

  // Returns true if the line may be one of the other frame size.
  bool isDoubted() const { return _gapsUntilTrusted != 0; }

  // Returns true if the line shows gaps: the first frame then begins at one.
  bool showsGaps() const { return _sinceGap < (_betweenGaps == 0 ? 2 * Format::Size : Unseen); }

  uint8_t _gapsUntilTrusted;   // gaps until frames are allowed again
  uint8_t _sinceGap;      // characters since a gap
  uint8_t _betweenGaps;  // characters between the two gaps before
  uint8_t _group;    // end byte of the group that is next in turn
  uint8_t _stretched;  // frames without gaps inside until the sender counts as one that stretches none
};

}  // namespace sbus
