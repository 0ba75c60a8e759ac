#include "PortSettings.h"

#include <stm32l0_uart.h>

#include "SerialConfig.h"

namespace host {

namespace {

// A plain core's values are plain numbers (see SerialConfig.h); here they are read as bits.
constexpr uint32_t Format8E2 =
    STM32L0_UART_OPTION_DATA_SIZE_8 | STM32L0_UART_OPTION_PARITY_EVEN | STM32L0_UART_OPTION_STOP_2;
static_assert(SERIAL_8E2 == Format8E2, "the plain core's numbers must have the bits of stm32l0_uart.h");

#if defined(HOST_PLAIN_CORE)
constexpr bool HasInverters = true;
#else
constexpr bool HasInverters = false;
#endif

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
  settings.polarity = HasInverters || (config & option) != 0 ? line::Polarity::Inverted : line::Polarity::Uninverted;
  settings.format = formatOf(config);
  return settings;
}

}  // namespace

PortSettings portSettings(unsigned long baud, uint32_t config) {
  return {pinSettings(baud, config, STM32L0_UART_OPTION_RX_INVERT),
          pinSettings(baud, config, STM32L0_UART_OPTION_TX_INVERT)};
}

}  // namespace host
