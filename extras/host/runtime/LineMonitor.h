// What went over the wire, whether the sketch received it or not.
#pragma once

#include "Line.h"
#include "sbus/Receiver.h"

namespace host {

class LineMonitor {
 public:
  void look(const Character &character);

  unsigned long characters() const { return _characters; }
  unsigned long frames() const { return _frames; }
  unsigned long lostFrames() const { return _lostFrames; }
  unsigned long failsafeFrames() const { return _failsafeFrames; }

 private:
  sbus::Receiver _receiver;
  unsigned long _characters = 0;
  unsigned long _frames = 0;
  unsigned long _lostFrames = 0;
  unsigned long _failsafeFrames = 0;
};

}  // namespace host
