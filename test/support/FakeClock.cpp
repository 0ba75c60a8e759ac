#include "FakeClock.h"

#include <Arduino.h>

uint64_t fakeMicros = 0;
uint64_t fakeStoodStillUs = 0;

uint32_t millis() {
  return static_cast<uint32_t>((fakeMicros - fakeStoodStillUs) / 1000);
}

uint32_t micros() {
  return static_cast<uint32_t>(fakeMicros - fakeStoodStillUs);
}

void delayMicroseconds(unsigned us) {
  fakeMicros += us;
}

void yield() {}
