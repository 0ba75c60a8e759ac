// What a sketch has set a port to, and whether that suits a wire.
#pragma once

#include <cstdint>
#include <string>

#include "Wire.h"

namespace host {

enum class Parity { None, Even, Odd };

struct PortSettings {
  unsigned long baud = 0;
  uint32_t config = 0;  // bits of stm32l0_uart.h

  unsigned dataBits() const;
  Parity parity() const;
  unsigned stopBits() const;

  uint32_t bitNs() const;
  uint32_t characterUs() const;

  // True if the port takes for idle what is idle on such a wire.
  bool agreesWith(Polarity polarity) const;
};

// In what they differ: "baud rate, format, polarity"; empty if the port is right for the wire.
std::string mismatch(const PortSettings &settings, const Wire &wire);

// "9600 baud, 8N1, not inverted"
std::string text(const PortSettings &settings);
std::string text(const Wire &wire);

}  // namespace host
