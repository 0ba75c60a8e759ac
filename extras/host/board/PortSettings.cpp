#include "PortSettings.h"

#include <stm32l0_uart.h>

namespace host {

namespace {

line::Format formatOf(uint32_t config) {
  line::Format format;
  format.dataBits = (config & STM32L0_UART_OPTION_DATA_SIZE_8) != 0 ? 8 : 7;
  format.parity = (config & STM32L0_UART_OPTION_PARITY_EVEN) != 0  ? line::Parity::Even
                  : (config & STM32L0_UART_OPTION_PARITY_ODD) != 0 ? line::Parity::Odd
                                                                   : line::Parity::None;
  format.stopBits = (config & STM32L0_UART_OPTION_STOP_2) != 0 ? 2 : 1;
  return format;
}

// Returns a pin's settings; `option` is the bit that inverts it.
line::LineSettings pinSettings(unsigned long baud, uint32_t config, uint32_t option) {
  line::LineSettings settings;
  settings.baud = baud;
  settings.polarity = (config & option) != 0 ? line::Polarity::Inverted : line::Polarity::Uninverted;
  settings.format = formatOf(config);
  return settings;
}

}  // namespace

PortSettings portSettings(unsigned long baud, uint32_t config) {
  return {pinSettings(baud, config, STM32L0_UART_OPTION_RX_INVERT),
          pinSettings(baud, config, STM32L0_UART_OPTION_TX_INVERT)};
}

}  // namespace host
