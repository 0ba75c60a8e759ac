// github.com/espressif/esp-idf 01b912a: components/hal/esp32/include/hal/uart_ll.h, as far as the library calls it.
#pragma once

#include <stdint.h>

#include "../../Uart.h"

using uart_dev_t = sim::Uart;
#define UART_LL_GET_HW(number) sim::uartOf(number)

namespace sim {
Uart *uartOf(int number);
}

uint32_t uart_ll_get_rxfifo_len(uart_dev_t *hw);
bool uart_ll_is_tx_idle(uart_dev_t *hw);
void uart_ll_write_txfifo(uart_dev_t *hw, const uint8_t *bytes, uint32_t size);
