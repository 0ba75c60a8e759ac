#include "Ticker.h"

#if defined(SBUS_TICKER)

namespace sbus {

Ticked *Ticked::first = nullptr;

bool Ticked::tickAll() {
  bool isDone = true;
  for (Ticked *ticked = first; ticked != nullptr; ticked = ticked->_next) {
    if (ticked->_isHeld) {
      ticked->_wasDue = true;
    } else if (!ticked->_poll(*ticked)) {
      isDone = false;
    }
  }
  return isDone;
}

void Ticked::startTicks(Poll *poll) {
  if (!Ticker::start()) {
    return;
  }
  const Ticker::Change change;
  _poll = poll;
  _next = first;
  barrier();
  first = this;
}

void Ticked::stopTicks() {
  const Ticker::Change change;
  for (Ticked **place = &first; *place != nullptr; place = &(*place)->_next) {
    if (*place == this) {
      *place = _next;
      break;
    }
  }
  if (first == nullptr) {
    Ticker::stop();
  }
}

}  // namespace sbus

#endif
