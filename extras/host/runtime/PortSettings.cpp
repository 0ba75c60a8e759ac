#include "PortSettings.h"

#include <stm32l0_uart.h>

#include <algorithm>

#include "SerialConfig.h"

namespace host {

namespace {

constexpr uint32_t Inversion = STM32L0_UART_OPTION_RX_INVERT | STM32L0_UART_OPTION_TX_INVERT;
constexpr uint32_t Format8E2 =
    STM32L0_UART_OPTION_DATA_SIZE_8 | STM32L0_UART_OPTION_PARITY_EVEN | STM32L0_UART_OPTION_STOP_2;
static_assert(SERIAL_8E2 == Format8E2, "the plain core's numbers must have the bits of stm32l0_uart.h");

bool inverts(const PortSettings &settings) {
#if defined(HOST_PLAIN_CORE)
  (void)settings;
  return true;  // such a board cannot: there is an inverter in front of its pin
#else
  return (settings.config & STM32L0_UART_OPTION_RX_INVERT) != 0;
#endif
}

}  // namespace

unsigned PortSettings::dataBits() const {
  return (config & STM32L0_UART_OPTION_DATA_SIZE_8) != 0 ? 8 : 7;
}

Parity PortSettings::parity() const {
  return (config & STM32L0_UART_OPTION_PARITY_EVEN) != 0  ? Parity::Even
         : (config & STM32L0_UART_OPTION_PARITY_ODD) != 0 ? Parity::Odd
                                                          : Parity::None;
}

unsigned PortSettings::stopBits() const {
  return (config & STM32L0_UART_OPTION_STOP_2) != 0 ? 2 : 1;
}

uint32_t PortSettings::bitNs() const {
  constexpr unsigned long SecondNs = 1000000000;
  return static_cast<uint32_t>(SecondNs / std::clamp(baud, 1ul, SecondNs));
}

uint32_t PortSettings::characterUs() const {
  const unsigned bits = 1 + dataBits() + (parity() == Parity::None ? 0 : 1) + stopBits();
  return static_cast<uint32_t>(uint64_t{bits} * bitNs() / 1000);
}

bool PortSettings::agreesWith(Polarity polarity) const {
  return polarity == Polarity::Either || inverts(*this) == (polarity == Polarity::Inverted);
}

std::string mismatch(const PortSettings &settings, const Wire &wire) {
  std::string names;
  const auto compare = [&names](bool same, const char *name) {
    names += same ? "" : names.empty() ? name : std::string(", ") + name;
  };
  compare(settings.baud == wire.baud, "baud rate");
  compare((settings.config & ~Inversion) == Format8E2, "format");
  compare(settings.agreesWith(wire.polarity), "polarity");
  return names;
}

std::string text(const PortSettings &settings) {
  const char parity[] = {'N', 'E', 'O'};
  return std::to_string(settings.baud) + " baud, " + std::to_string(settings.dataBits()) +
         parity[static_cast<int>(settings.parity())] + std::to_string(settings.stopBits()) +
         (inverts(settings) ? ", inverted" : ", not inverted");
}

std::string text(const Wire &wire) {
  const char *const polarity = wire.polarity == Polarity::Inverted     ? ", inverted"
                               : wire.polarity == Polarity::Uninverted ? ", not inverted"
                                                                       : "";
  return std::to_string(wire.baud) + " baud, 8E2" + polarity;
}

}  // namespace host
