// Finds what is damaged between two frames: bytes that are neither a frame nor telemetry of S.BUS2.
#pragma once

#include "line/Segments.h"

namespace scope {

class Damage {
 public:
  // Takes the next stretch; `followsSlots`: it is a frame, and proves that what was before it is telemetry. Returns
  // when the first damaged bytes since the last frame had come, in us, as soon as they are certainly damaged; otherwise
  // 0. Bytes before the first frame are half of one, and do not count.
  uint64_t take(const line::Stretch &stretch, bool followsSlots);

 private:
  bool _seen = false;    // a frame
  bool _hasBad = false;  // a character with an error came since the newest frame
  bool _hasHeader = false;
  size_t _mostOfNone = 0;  // characters after the newest frame that may be no part of one
  size_t _count = 0;       // characters since then
  uint64_t _sinceUs = 0;   // when the first of them had come
};

}  // namespace scope
