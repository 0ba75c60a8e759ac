#include "Receiver.h"

#include <string.h>

namespace sbus {

void Receiver::reset() {
  _filled = 0;
  _hasFrame = false;
}

bool Receiver::received(uint8_t count) {
  _filled = static_cast<uint8_t>(_filled + count);
  if (_filled != 0 && _incoming[0] != HeaderByte) {
    discardToHeader(0);
  }
  if (_filled < FrameSize) {
    return false;
  }
  if (!isFrame(_incoming)) {
    discardToHeader(1);
    return false;
  }
  uint8_t *const newest = _incoming;
  _incoming = _complete;
  _complete = newest;
  _filled = 0;
  _hasFrame = true;
  return true;
}

// Lets the incoming frame begin at the first header at or behind `from`. Nothing that may be a frame is thrown away:
// a payload may hold 0F, and the true header may stand behind it.
void Receiver::discardToHeader(uint8_t from) {
  while (from < _filled && _incoming[from] != HeaderByte) {
    from++;
  }
  _filled = static_cast<uint8_t>(_filled - from);
  memmove(_incoming, _incoming + from, _filled);
}

}  // namespace sbus
