/// @file
/// Hands channels of a teacher's receiver to a pupil's.
#pragma once

#include <stdint.h>

#include "Frame.h"
#include "ReceiverChoice.h"
#include "Scaling.h"

namespace sbus {

/// Hands some channels to the pupil while a switch of the teacher is above +50 %, so that the middle of three positions
/// is off, and both receivers are usable. The mixed frame keeps the teacher's flags.
class Trainer {
 public:
  /// `toggle` is the teacher's switch, 0 for CH1, and `channels` what it hands over, bit 0 for CH1, bit 15 for CH16.
  explicit constexpr Trainer(uint8_t toggle, uint16_t channels, const Range &range)
      : _range(range), _channels(channels), _toggle(toggle) {}

  /// Takes what is known of the pupil's receiver at `now`, ms, which may wrap. Call it in every loop(). The pupil is
  /// lost at once in failsafe and without frames, and after 0.1 s of lost frames alone.
  void hear(const Reception &pupil, uint32_t now) {
    if (pupil.state == LinkState::Ok) {
      _heard = now - static_cast<uint32_t>(pupil.age);
      _hasPupil = true;
    }
    _hasPupil = _hasPupil && pupil.isUsable() && now - _heard < Reception::UsableAgeMax;
  }

  /// Copies the pupil's channels into the teacher's `frame` if the pupil flies, and then returns true. Each has 16
  /// values or more. Call it for each frame that is sent, after hear().
  bool train(uint16_t *frame, const Reception &teacher, const uint16_t *pupils) const {
    constexpr int16_t OnAbove = 500;
    if (!_hasPupil || !teacher.isUsable() || toNormalized(frame[_toggle], _range) <= OnAbove) {
      return false;
    }
    for (uint8_t i = 0; i < ProportionalCount; i++) {
      if ((_channels >> i & 1) != 0) {
        frame[i] = pupils[i];
      }
    }
    return true;
  }

 private:
  Range _range;
  uint32_t _heard = 0;  // ms, when the pupil's newest frame without a flag came
  uint16_t _channels;
  uint8_t _toggle;
  bool _hasPupil = false;
};

}  // namespace sbus
