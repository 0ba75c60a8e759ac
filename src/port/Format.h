/// @file
/// The format of an S.Bus line as the core names it: 8 data bits, even parity, 2 stop bits, inverted.
#pragma once

#include <stdint.h>

#include "Core.h"

namespace sbus {

// Orders overloads: of those that compile, the one with the highest number is called.
template <int Number>
struct Rank : Rank<Number - 1> {};
template <>
struct Rank<0> {};

/// The core's SERIAL_8E2, a macro or an enumerator (ESP32, ESP8266). Teensy 3.2 and nRF52832 have only SERIAL_8E1: they
/// see the second stop bit as an idle line.
#if defined(SERIAL_8E1) && !defined(SERIAL_8E2)
constexpr auto EvenConfig = SERIAL_8E1;
#else
constexpr auto EvenConfig = SERIAL_8E2;
#endif

/// Marks an inverted line in a format that has no bit for it. No core uses this bit.
constexpr uint32_t InvertedBit = 0x80000000;

/// The format that begin() opens a port with: inverted, if the port can invert.
#if defined(SERIAL_SBUS)  // STM32L0
constexpr uint32_t PortConfig = SERIAL_SBUS;
#elif defined(SERIAL_8E2_RXINV_TXINV)  // Teensy
constexpr uint32_t PortConfig = SERIAL_8E2_RXINV_TXINV;
#elif defined(SERIAL_8E1_RXINV_TXINV)  // Teensy 3.2
constexpr uint32_t PortConfig = SERIAL_8E1_RXINV_TXINV;
#else
constexpr uint32_t PortConfig = static_cast<uint32_t>(EvenConfig) | InvertedBit;
#endif

// A format that converts to the type of the core's begin(): 8, 16 or 32 bits, or an enum.
struct Config {
  uint32_t value;  // a format of the core, or PortConfig
  // Returns true if the port must be told separately to invert the line.
  bool inverted() const { return (value & InvertedBit) != 0; }
  // Returns the core's format.
  template <typename Format>
  operator Format() const {
    return static_cast<Format>(value & ~InvertedBit);
  }
};

}  // namespace sbus
