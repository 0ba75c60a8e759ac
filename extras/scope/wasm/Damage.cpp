#include "Damage.h"

#include <algorithm>

#include "sbus/FrameRules.h"

namespace scope {

// A few good characters without a header cost no frame: some receivers send a tail. FrameMin of them and more did.
uint64_t Damage::take(const line::Stretch &stretch, bool followsSlots) {
  constexpr size_t FrameMin = sbus::FrameSize - sbus::rules::MostNoise;
  if (stretch.isFrame()) {
    const bool isDamaged = _seen && !followsSlots && (_isOdd || _count >= FrameMin);
    const uint64_t sinceUs = isDamaged ? _sinceUs : 0;
    _seen = true;
    _isOdd = false;
    _count = 0;
    return sinceUs;
  }
  _sinceUs = _count == 0 ? stretch.endUs() : _sinceUs;
  _count += stretch.characters.size();
  _isOdd = _isOdd || std::any_of(stretch.characters.begin(), stretch.characters.end(), [](const line::Character &each) {
             return each.bad || each.value == sbus::HeaderByte;
           });
  return 0;
}

}  // namespace scope
