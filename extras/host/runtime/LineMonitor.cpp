#include "LineMonitor.h"

#include "sbus/Frame.h"

namespace host {

void LineMonitor::look(const Character &character) {
  _characters++;
  if (character.bad) {
    return;
  }
  *_receiver.space() = character.value;
  if (!_receiver.received(1)) {
    return;
  }
  _frames++;
  _lostFrames += sbus::lostFrame(_receiver.frame());
  _failsafeFrames += sbus::failsafe(_receiver.frame());
}

}  // namespace host
