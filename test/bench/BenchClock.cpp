// The clock of the bench: the unit programs' millis() divides 64 bits, and that would be most of what a frame costs.
// This one takes about as many instructions as the STM32L0's, which converts the RTC's date (stm32l0_rtc.c:496).
#include "support/FakeClock.h"

#include <Arduino.h>
#include <stm32l0_system.h>

uint64_t fakeMicros = 0;

uint32_t micros() { return static_cast<uint32_t>(fakeMicros); }

uint32_t millis() { return static_cast<uint32_t>(fakeMicros) / 1000; }

void delayMicroseconds(unsigned us) { fakeMicros += us; }

void yield() {}

// Nothing here sleeps.
void stm32l0_system_register(stm32l0_system_notify_t *, stm32l0_system_callback_t, void *, uint32_t) {}

void stm32l0_system_unregister(stm32l0_system_notify_t *) {}
