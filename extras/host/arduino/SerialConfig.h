// The formats that begin(baud, config) takes.
#pragma once

#if defined(HOST_PLAIN_CORE)

// A plain core's values are plain numbers. Their bits happen to be those of stm32l0_uart.h, which no sketch can notice.
#define SERIAL_8N1 0x10
#define SERIAL_8N2 0x11
#define SERIAL_8E1 0x12
#define SERIAL_8E2 0x13
#define SERIAL_8O1 0x14
#define SERIAL_8O2 0x15

#else

// As on the board, these are made of names that stand in stm32l0_uart.h, and Arduino.h does not bring that in: a source
// that uses one of them without including it does not compile.
#define SERIAL_8N1 (STM32L0_UART_OPTION_DATA_SIZE_8 | STM32L0_UART_OPTION_PARITY_NONE | STM32L0_UART_OPTION_STOP_1)
#define SERIAL_8N2 (STM32L0_UART_OPTION_DATA_SIZE_8 | STM32L0_UART_OPTION_PARITY_NONE | STM32L0_UART_OPTION_STOP_2)
#define SERIAL_8E1 (STM32L0_UART_OPTION_DATA_SIZE_8 | STM32L0_UART_OPTION_PARITY_EVEN | STM32L0_UART_OPTION_STOP_1)
#define SERIAL_8E2 (STM32L0_UART_OPTION_DATA_SIZE_8 | STM32L0_UART_OPTION_PARITY_EVEN | STM32L0_UART_OPTION_STOP_2)
#define SERIAL_8O1 (STM32L0_UART_OPTION_DATA_SIZE_8 | STM32L0_UART_OPTION_PARITY_ODD | STM32L0_UART_OPTION_STOP_1)
#define SERIAL_8O2 (STM32L0_UART_OPTION_DATA_SIZE_8 | STM32L0_UART_OPTION_PARITY_ODD | STM32L0_UART_OPTION_STOP_2)
#define SERIAL_SBUS (SERIAL_8E2 | STM32L0_UART_OPTION_RX_INVERT | STM32L0_UART_OPTION_TX_INVERT)

#endif
