// The option bits of a UART. The names are the board's, the values are our own. And what the library reads of the
// core's state of a UART (GrumpyOldPizza/ArduinoCore-stm32l0 b1cf1cd, system/STM32L0xx/Include/stm32l0_uart.h:125).
#pragma once

#include <stdint.h>

#define STM32L0_UART_OPTION_STOP_1 0x00
#define STM32L0_UART_OPTION_STOP_2 0x01
#define STM32L0_UART_OPTION_PARITY_NONE 0x00
#define STM32L0_UART_OPTION_PARITY_EVEN 0x02
#define STM32L0_UART_OPTION_PARITY_ODD 0x04
#define STM32L0_UART_OPTION_DATA_SIZE_7 0x00
#define STM32L0_UART_OPTION_DATA_SIZE_8 0x10
#define STM32L0_UART_OPTION_RX_INVERT 0x20
#define STM32L0_UART_OPTION_TX_INVERT 0x40

#define STM32L0_UART_EVENT_RECEIVE 0x40

typedef struct _stm32l0_uart_t {
  uint16_t rx_index;           // of the ring: what comes before was handed over
  volatile uint32_t rx_count;  // handed over and not read
  volatile uint8_t rx_event;   // the next byte handed over makes an event
} stm32l0_uart_t;
