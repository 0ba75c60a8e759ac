// How the board's core tells that it is about to sleep (GrumpyOldPizza/ArduinoCore-stm32l0 b1cf1cd,
// system/STM32L0xx/Include/stm32l0_system.h:107, 119, 194; Source/stm32l0_system.c:1537, 1631).
#pragma once

#include <stdint.h>

typedef void (*stm32l0_system_callback_t)(void *context, uint32_t events);

typedef struct _stm32l0_system_notify_t {
  struct _stm32l0_system_notify_t *next;
  stm32l0_system_callback_t callback;
  void *context;
  uint32_t mask;
} stm32l0_system_notify_t;

#if defined(STM32L0_CORE_0_0)  // releases up to 0.0.10
#define STM32L0_SYSTEM_EVENT_SLEEP 0x00000002
void stm32l0_system_notify(stm32l0_system_notify_t *notify, stm32l0_system_callback_t callback, void *context,
                           uint32_t events);
#else
#define STM32L0_SYSTEM_NOTIFY_SLEEP 0x00000002
void stm32l0_system_register(stm32l0_system_notify_t *notify, stm32l0_system_callback_t callback, void *context,
                             uint32_t mask);
void stm32l0_system_unregister(stm32l0_system_notify_t *notify);
#endif
