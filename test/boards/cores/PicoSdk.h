// github.com/raspberrypi/pico-sdk 2.2.0 (a1438df), as far as the library calls it: src/rp2_common, hardware_irq and
// hardware_timer. build.mk gives it the names of all these headers.
#pragma once

#include <stdint.h>

unsigned get_core_num();

#define PICO_DEFAULT_IRQ_PRIORITY 0x80
#define PICO_LOWEST_IRQ_PRIORITY 0xff
void irq_set_priority(unsigned number, uint8_t priority);

uint32_t save_and_disable_interrupts();
void restore_interrupts(uint32_t status);

using uint = unsigned;
using absolute_time_t = uint64_t;
using hardware_alarm_callback_t = void (*)(uint alarm);

int hardware_alarm_claim_unused(bool required);
void hardware_alarm_unclaim(uint alarm);
void hardware_alarm_set_callback(uint alarm, hardware_alarm_callback_t callback);
bool hardware_alarm_set_target(uint alarm, absolute_time_t target);
void hardware_alarm_cancel(uint alarm);
uint hardware_alarm_get_irq_num(uint alarm);

uint32_t time_us_32();
uint64_t time_us_64();
void busy_wait_us_32(uint32_t us);
inline absolute_time_t from_us_since_boot(uint64_t us) { return us; }
