#include "PolledByTimer.h"

#if defined(SBUS_POLLING_TIMER)

namespace sbus {

namespace {

// Keeps the timer from reading the list, while it exists.
#if defined(SBUS_AVR)
struct Change {  // an interrupt could come between the two bytes of a pointer
  explicit Change(const PolledByTimer &) { cli(); }
  ~Change() { SREG = state; }
  const uint8_t state = SREG;
};
#elif defined(SBUS_ESP32)
using Change = PolledByTimer::Lock;
#else
struct Change {
  explicit Change(const PolledByTimer &) {}
};
#endif

}  // namespace

PolledByTimer *PolledByTimer::first = nullptr;

bool PolledByTimer::pollDecoders() {
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
  if (!startTimer()) {
    return;
  }
  const Change change(*this);
  _poll = callback;
  _next = first;
  barrier();
  first = this;
}

void PolledByTimer::stopPolling() {
  const Change change(*this);
  for (PolledByTimer **place = &first; *place != nullptr; place = &(*place)->_next) {
    if (*place == this) {
      *place = _next;
      break;
    }
  }
  if (first == nullptr) {
    stopTimer();
  }
}

}  // namespace sbus

#endif
