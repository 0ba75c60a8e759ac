// github.com/raspberrypi/pico-sdk 2.2.0: src/rp2_common/hardware_irq/include/hardware/irq.h:162.
#pragma once

#include <stdint.h>

#define PICO_DEFAULT_IRQ_PRIORITY 0x80
#define PICO_LOWEST_IRQ_PRIORITY 0xff

void irq_set_priority(unsigned number, uint8_t priority);
