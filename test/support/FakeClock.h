// millis() and micros() of the unit programs: both come from one counter, cut to 32 bits each, as on the board.
#pragma once

#include <cstdint>

extern uint64_t fakeMicros;

// How long the sketch's clock has stood still: what it shows lags behind `fakeMicros` by this.
extern uint64_t fakeStoodStillUs;

// How long micros() alone has stood still.
extern uint64_t fakeMicrosStoodUs;

// Where micros() and millis() wrap.
constexpr uint64_t MicrosWrap = uint64_t{1} << 32;           // us: 71 minutes and 35 seconds
constexpr uint64_t MillisWrap = (uint64_t{1} << 32) * 1000;  // us: 49 days and 17 hours

// The board sleeps for this time, and so does loop(). GrumpyOldPizza/ArduinoCore-stm32l0 b1cf1cd: micros() is SysTick,
// which counts the processor's clock (cores/arduino/delay.c:43, armv6m_systick.c:65); millis() is the RTC
// (cores/arduino/delay.c:36).
//
// STM32L0.sleep() divides the processor's clock by 16 while it waits for an interrupt (stm32l0_system.c:872, 1660).
// Interrupts then run at the whole clock: on an emulator, micros() was 14.8 times too slow.
// fakeFallAsleep() goes before: the core tells that it will sleep (:1631).
void fakeFallAsleep();
void fakeSleep(uint64_t us);
// STM32L0.deepsleep() is the processor's STOP, which halts this clock (stm32l0_system.c:1733). The UART's clock stands
// as well, and characters are lost.
void fakeDeepSleep(uint64_t us);
// Forgets who asked to be told: the board is another.
void fakeReset();
