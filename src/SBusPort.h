/// @file
/// How DecodeSBus and EncodeSBus open a port. For sketches it only brings in what SERIAL_8E2 and the like are made of.
#pragma once

#include <Arduino.h>

#if defined(SERIAL_SBUS)
#include <stm32l0_uart.h>  // the option bits that SERIAL_SBUS is made of; Arduino.h does not bring them in
#endif

namespace sbus {

#if defined(SERIAL_SBUS)
constexpr auto PortConfig = SERIAL_SBUS;  ///< 8E2, inverted
#else
constexpr auto PortConfig = SERIAL_8E2;  ///< the line needs an inverter
#endif

/// port.begin(baud, config), as open(port, &HardwareSerial::begin, baud, config): a format is a byte on some cores
/// (AVR), 32 bits on others.
template <typename Format>
void open(HardwareSerial &port, void (HardwareSerial::*begin)(unsigned long, Format), unsigned long baud,
          uint32_t config) {
  (port.*begin)(baud, static_cast<Format>(config));
}

}  // namespace sbus
