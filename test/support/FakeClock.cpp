#include "FakeClock.h"

#include <Arduino.h>

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

uint32_t micros() {
  return static_cast<uint32_t>(fakeMicros - fakeStoodStillUs - fakeMicrosStoodUs);
}

void delayMicroseconds(unsigned us) {
  fakeMicros += us;
}

void yield() {}

void fakeSleep(uint64_t us) {
  constexpr uint64_t Divider = 16;
  const uint64_t before = fakeMicros / Divider;
  fakeMicros += us;
  fakeMicrosStoodUs += us - (fakeMicros / Divider - before);
}

void fakeDeepSleep(uint64_t us) {
  fakeMicros += us;
  fakeMicrosStoodUs += us;
}
