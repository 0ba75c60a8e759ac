// The core's servo driver: pulses at pins. Nothing moves; at the end the program prints each pin's settings.
#pragma once

#include <stdint.h>

#define STM32L0_TIMER_INSTANCE_TIM7 7

typedef struct {
  unsigned instance;
} stm32l0_timer_t;

#define STM32L0_SERVO_STATE_NONE 0
#define STM32L0_SERVO_STATE_INIT 1
#define STM32L0_SERVO_STATE_ACTIVE 4

#define STM32L0_SERVO_SLOT_COUNT 10

typedef struct {
  uint32_t entries;
  struct {
    uint16_t pin;
    uint16_t width;  // us
  } slot[STM32L0_SERVO_SLOT_COUNT];
} stm32l0_servo_table_t;

typedef struct {
  volatile uint8_t state;
  stm32l0_servo_table_t set;  // the pins' current pulses
} stm32l0_servo_t;

typedef void (*stm32l0_servo_event_callback_t)(void *context, uint32_t events);

bool stm32l0_timer_create(stm32l0_timer_t *timer, unsigned instance, unsigned priority, unsigned mode);
bool stm32l0_servo_create(stm32l0_servo_t *servo, stm32l0_timer_t *timer);
bool stm32l0_servo_enable(stm32l0_servo_t *servo, const stm32l0_servo_table_t *table,
                          stm32l0_servo_event_callback_t callback, void *context);
bool stm32l0_servo_configure(stm32l0_servo_t *servo, const stm32l0_servo_table_t *table);
