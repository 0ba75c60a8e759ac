#include "PortSettings.h"

#include <stm32l0_uart.h>

#include "SerialConfig.h"
#include "sbus/Frame.h"

namespace host {

namespace {

constexpr uint32_t Inversion = STM32L0_UART_OPTION_RX_INVERT | STM32L0_UART_OPTION_TX_INVERT;
constexpr uint32_t Format8E2 =
    STM32L0_UART_OPTION_DATA_SIZE_8 | STM32L0_UART_OPTION_PARITY_EVEN | STM32L0_UART_OPTION_STOP_2;
static_assert(SERIAL_8E2 == Format8E2, "the plain core's numbers must have the bits of stm32l0_uart.h");

}  // namespace

bool understandsSBus(const PortSettings &settings, bool inverted) {
#if defined(HOST_PLAIN_CORE)
  inverted = false;  // such a board cannot invert: there is an inverter on the wire
#endif
  const bool inverts = (settings.config & STM32L0_UART_OPTION_RX_INVERT) != 0;
  return settings.baud == sbus::Baud && (settings.config & ~Inversion) == Format8E2 && (inverts || !inverted);
}

std::string text(const PortSettings &settings) {
  const char dataBits = (settings.config & STM32L0_UART_OPTION_DATA_SIZE_8) != 0 ? '8' : '7';
  const char parity = (settings.config & STM32L0_UART_OPTION_PARITY_EVEN) != 0  ? 'E'
                      : (settings.config & STM32L0_UART_OPTION_PARITY_ODD) != 0 ? 'O'
                                                                                : 'N';
  const char stopBits = (settings.config & STM32L0_UART_OPTION_STOP_2) != 0 ? '2' : '1';
  const bool inverts = (settings.config & STM32L0_UART_OPTION_RX_INVERT) != 0;
  return std::to_string(settings.baud) + " baud, " + dataBits + parity + stopBits +
         (inverts ? ", inverted" : ", not inverted");
}

}  // namespace host
