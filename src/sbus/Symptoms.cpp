#include "Symptoms.h"

namespace sbus {

void Symptoms::accepted(const uint8_t *frame) {
  const uint8_t flags = frame[FlagsIndex];
  _pulseless += (flags & (FlagLostFrame | FlagFailsafe)) == 0 && Frame16NoPulses::isZero(frame);
  _rhythm.put((flags & FlagLostFrame) != 0);
  put(frame, FrameSize);
}

void Symptoms::discarded(const uint8_t *bytes, int count) {
  for (int i = 0; i < count; i++) {
    _protocols.put(bytes[i]);
  }
  put(bytes, count);
}

void Symptoms::gap(int filled) {
  if (filled == 0) {
    _packets.gap();
  } else if (_gapCount < GapsMax && (_gapCount == 0 || _gaps[_gapCount - 1] != filled)) {
    _gaps[_gapCount++] = static_cast<uint8_t>(filled);
  }
}

void Symptoms::put(const uint8_t *bytes, int count) {
  for (int i = 0; i < count; i++) {
    _packets.put(bytes[i]);
    uint8_t reached = 0;
    for (uint8_t gap = 0; gap < _gapCount; gap++) {
      reached = static_cast<uint8_t>(reached + (--_gaps[gap] == 0));
    }
    if (reached != 0) {  // one at most
      _packets.gap();
      _gapCount--;
      for (uint8_t gap = 0; gap < _gapCount; gap++) {
        _gaps[gap] = _gaps[gap + 1];
      }
    }
  }
}

}  // namespace sbus
