#include "Damage.h"

#include "sbus/FrameRules.h"
#include "sbus2/Slots.h"

namespace scope {

// A few valid characters without a header are no lost frame: some receivers send a tail. FrameMin of them or more are
// one.
uint64_t Damage::take(const line::Stretch &stretch, bool followsSlots) {
  constexpr size_t FrameMin = sbus::FrameSize - sbus::rules::NoiseMax;
  if (stretch.isFrame()) {
    const bool isDamaged = _seen && !followsSlots && (_hasBad || _hasHeader || _count >= FrameMin);
    const uint64_t sinceUs = isDamaged ? _sinceUs : 0;
    _seen = true;
    _mostOfNone = sbus::announcesSlots(stretch.characters.back().value) ? size_t{sbus::GroupSizeMax} : FrameMin - 1;
    _hasBad = _hasHeader = false;
    _count = 0;
    return sinceUs;
  }
  _sinceUs = _count == 0 ? stretch.endUs() : _sinceUs;
  _count += stretch.characters.size();
  for (const line::Character &each : stretch.characters) {
    _hasBad = _hasBad || each.bad;
    _hasHeader = _hasHeader || each.value == sbus::HeaderByte;
  }
  // At a recording's end no frame follows, and half of one may be there.
  return _seen && (_hasBad || _count > _mostOfNone) ? _sinceUs : 0;
}

}  // namespace scope
