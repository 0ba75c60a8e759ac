#include "Ticker.h"

#if defined(SBUS_TICKER)

namespace sbus {

PolledByTimer *PolledByTimer::first = nullptr;

bool PolledByTimer::tickAll() {
  bool isDone = true;
  for (PolledByTimer *decoder = first; decoder != nullptr; decoder = decoder->_next) {
    if (decoder->_isLocked) {
      decoder->_wasDue = true;
    } else if (!decoder->_poll(*decoder)) {
      isDone = false;
    }
  }
  return isDone;
}

void PolledByTimer::startPolling(Poll *callback) {
  if (!Ticker::start()) {
    return;
  }
  const Ticker::Change change;
  _poll = callback;
  _next = first;
  barrier();
  first = this;
}

void PolledByTimer::stopPolling() {
  const Ticker::Change change;
  for (PolledByTimer **place = &first; *place != nullptr; place = &(*place)->_next) {
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
