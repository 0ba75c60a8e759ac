#include "PolledByTimer.h"

#if defined(SBUS_TEENSY)

#include <IntervalTimer.h>

namespace sbus {

namespace {

constexpr int Period = 1000;     // us
constexpr uint8_t Lowest = 255;  // priority

IntervalTimer timer;
bool isRunning = false;

void elapsed() { PolledByTimer::pollDecoders(); }

}  // namespace

bool PolledByTimer::startTimer() {
  if (!isRunning) {
    timer.priority(Lowest);
    isRunning = timer.begin(elapsed, Period);
  }
  return isRunning;
}

void PolledByTimer::stopTimer() {
  timer.end();
  isRunning = false;
}

}  // namespace sbus

#endif
