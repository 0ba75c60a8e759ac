#include "PortSettings.h"

#include <stm32l0_uart.h>

#include "SerialConfig.h"

namespace host {

namespace {

// A plain core's values are plain numbers, see SerialConfig.h: here they are read as bits.
constexpr uint32_t Format8E2 =
    STM32L0_UART_OPTION_DATA_SIZE_8 | STM32L0_UART_OPTION_PARITY_EVEN | STM32L0_UART_OPTION_STOP_2;
static_assert(SERIAL_8E2 == Format8E2, "the plain core's numbers must have the bits of stm32l0_uart.h");

// `option`: the one of the pin that is asked for.
bool inverts(const PortSettings &settings, uint32_t option) {
#if defined(HOST_PLAIN_CORE)
  (void)settings;
  (void)option;
  return true;  // such a board cannot: there is an inverter at its pin
#else
  return (settings.config & option) != 0;
#endif
}

bool invertsRx(const PortSettings &settings) {
  return inverts(settings, STM32L0_UART_OPTION_RX_INVERT);
}

std::string text(unsigned long baud, const Format &format) {
  const char parity[] = {'N', 'E', 'O'};
  return std::to_string(baud) + " baud, " + std::to_string(format.dataBits) + parity[static_cast<int>(format.parity)] +
         std::to_string(format.stopBits);
}

}  // namespace

Format PortSettings::format() const {
  Format format;
  format.dataBits = (config & STM32L0_UART_OPTION_DATA_SIZE_8) != 0 ? 8 : 7;
  format.parity = (config & STM32L0_UART_OPTION_PARITY_EVEN) != 0  ? Parity::Even
                  : (config & STM32L0_UART_OPTION_PARITY_ODD) != 0 ? Parity::Odd
                                                                   : Parity::None;
  format.stopBits = (config & STM32L0_UART_OPTION_STOP_2) != 0 ? 2 : 1;
  return format;
}

bool PortSettings::agreesWith(Polarity polarity) const {
  return polarity == Polarity::Either || invertsRx(*this) == (polarity == Polarity::Inverted);
}

Wire wireFrom(const PortSettings &settings) {
  Wire wire;
  wire.baud = settings.baud;
  wire.polarity = inverts(settings, STM32L0_UART_OPTION_TX_INVERT) ? Polarity::Inverted : Polarity::Uninverted;
  wire.format = settings.format();
  return wire;
}

std::string mismatch(const PortSettings &settings, const Wire &wire) {
  std::string names;
  const auto compare = [&names](bool same, const char *name) {
    names += same ? "" : names.empty() ? name : std::string(", ") + name;
  };
  compare(settings.baud == wire.baud, "baud rate");
  compare(settings.format() == wire.format, "format");
  compare(settings.agreesWith(wire.polarity), "polarity");
  return names;
}

std::string text(const PortSettings &settings) {
  return text(settings.baud, settings.format()) + (invertsRx(settings) ? ", inverted" : ", not inverted");
}

std::string text(const Wire &wire) {
  const char *const polarity = wire.polarity == Polarity::Inverted     ? ", inverted"
                               : wire.polarity == Polarity::Uninverted ? ", not inverted"
                                                                       : "";
  return text(wire.baud, wire.format) + polarity;
}

}  // namespace host
