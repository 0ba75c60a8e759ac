#include "Link.h"

#include "Frame.h"

namespace sbus {

void Link::reset() {
  _state = LinkState::NeverSeen;
  _losses = 0;
  _stale = false;
}

}  // namespace sbus
