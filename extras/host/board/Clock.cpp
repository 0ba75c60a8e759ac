#include "Clock.h"

#include <thread>

namespace host {

namespace {

constexpr uint64_t SleepUs = 1000;  // sleeping more often costs CPU time and makes nothing visibly smoother

}  // namespace

Clock::Clock(Pace pace, uint32_t startMs) : _pace(pace), _startUs(uint64_t{startMs} * 1000) {}

void Clock::spend(uint64_t us) {
  _nowUs += us;
  if (_pace == Pace::Real && _nowUs >= _nextSleepUs) {
    std::this_thread::sleep_until(_start + std::chrono::microseconds(_nowUs));
    _nextSleepUs = _nowUs + SleepUs;
  }
}

}  // namespace host
