#include "FakeClock.h"

#include <stm32l0_system.h>

#include <algorithm>
#include <vector>

// Last: its macros break the C++ library.
#include <Arduino.h>

namespace {

std::vector<stm32l0_system_notify_t *> told;

}  // namespace

uint64_t fakeMicros = 0;
uint64_t fakeStoodStillUs = 0;
uint64_t fakeMicrosStoodUs = 0;

// The STM32L0's RTC counts 2048 ticks a second (stm32l0_rtc.h:94), so that millis() jumps by 2 at times, and is up to
// 1.5 ms behind (stm32l0_rtc.h:284).
uint32_t millis() {
  constexpr uint64_t TicksPerSecond = 2048;
  const uint64_t ticks = (fakeMicros - fakeStoodStillUs) * TicksPerSecond / 1000000;
  return static_cast<uint32_t>(ticks / TicksPerSecond * 1000 + ticks % TicksPerSecond * 1000 / TicksPerSecond);
}

uint32_t micros() { return static_cast<uint32_t>(fakeMicros - fakeStoodStillUs - fakeMicrosStoodUs); }

void delayMicroseconds(unsigned us) { fakeMicros += us; }

void yield() {}

// An object that is gone without end() may still stand in the list: nothing looks at it but fakeFallAsleep().
void stm32l0_system_register(stm32l0_system_notify_t *notify, stm32l0_system_callback_t callback, void *context,
                             uint32_t mask) {
  *notify = {nullptr, callback, context, mask};
  told.push_back(notify);
}

void stm32l0_system_unregister(stm32l0_system_notify_t *notify) {
  told.erase(std::remove(told.begin(), told.end(), notify), told.end());
}

void fakeFallAsleep() {
  for (stm32l0_system_notify_t *const notify : std::vector<stm32l0_system_notify_t *>(told)) {
    if ((notify->mask & STM32L0_SYSTEM_NOTIFY_SLEEP) != 0) {
      notify->callback(notify->context, STM32L0_SYSTEM_NOTIFY_SLEEP);
    }
  }
}

void fakeReset() { told.clear(); }

void fakeSleep(uint64_t us) {
  constexpr uint64_t Divider = 16;
  const uint64_t before = fakeMicros / Divider;
  fakeMicros += us;
  fakeMicrosStoodUs += us - (fakeMicros / Divider - before);
}

void fakeDeepSleep(uint64_t us) {
  fakeFallAsleep();
  fakeMicros += us;
  fakeMicrosStoodUs += us;
}
