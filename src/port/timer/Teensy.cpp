#include "PolledByTimer.h"

#if defined(SBUS_TEENSY)

#include <IntervalTimer.h>

namespace sbus {

namespace {

constexpr int Period = 1000;     // us
constexpr uint8_t Lowest = 255;  // priority

IntervalTimer timer;
bool isRunning = false;

// A Teensy 4 has one interrupt for all IntervalTimers, with the highest of their priorities
// (teensy4/IntervalTimer.h:84). If the sketch has one above the UART's, the UART's interrupt may be the one that this
// one interrupts; both read the FIFO (HardwareSerial.cpp:551, 622). So it only interrupts loop().
bool isInPort() {
#if defined(SBUS_IMXRT)
  constexpr uint32_t ReturnsToBase = 1 << 11;  // RETTOBASE: no other interrupt is active
  return (SCB_ICSR & ReturnsToBase) == 0;
#else
  return false;
#endif
}

void elapsed() {
  if (!isInPort()) {
    PolledByTimer::tickAll();
  }
}

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
