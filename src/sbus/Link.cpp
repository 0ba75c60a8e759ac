#include "Link.h"

#include "Frame.h"

namespace sbus {

void Link::reset() {
  _state = LinkState::NeverSeen;
  _losses = 0;
  _stale = false;
}

void Link::frame(uint8_t flags) {
  if ((flags & (FlagLostFrame | FlagFailsafe)) == 0) {
    _losses = 0;
    _state = LinkState::Ok;
    return;
  }
  if ((flags & FlagLostFrame) == 0) {
    _losses = 0;
  } else if (_losses < UINT16_MAX) {
    _losses++;
  }
  const bool tooMany = _lossLimit != 0 && _losses >= _lossLimit;
  _state = tooMany || (flags & FlagFailsafe) != 0 ? LinkState::Failsafe : LinkState::Lossy;
}

}  // namespace sbus
