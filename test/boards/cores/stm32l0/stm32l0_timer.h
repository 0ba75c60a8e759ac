// What port/timer/Stm32L0.cpp calls, only to compile it: GrumpyOldPizza/ArduinoCore-stm32l0 b1cf1cd,
// system/STM32L0xx/Include/stm32l0_timer.h:105.
#pragma once

#include <stdint.h>

struct stm32l0_timer_t {};
enum { STM32L0_TIMER_INSTANCE_TIM7, STM32L0_TIMER_EVENT_PERIOD };

bool stm32l0_timer_create(stm32l0_timer_t *timer, unsigned instance, unsigned priority, unsigned mode);
bool stm32l0_timer_destroy(stm32l0_timer_t *timer);
uint32_t stm32l0_timer_clock(stm32l0_timer_t *timer);
bool stm32l0_timer_enable(stm32l0_timer_t *timer, uint32_t prescaler, uint32_t option,
                          void (*callback)(void *, uint32_t), void *context, uint32_t events);
bool stm32l0_timer_disable(stm32l0_timer_t *timer);
bool stm32l0_timer_start(stm32l0_timer_t *timer, uint32_t period, bool oneshot);
bool stm32l0_timer_stop(stm32l0_timer_t *timer);
