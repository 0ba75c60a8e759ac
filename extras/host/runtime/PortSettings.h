// What a sketch has set a port to, and whether that suits a wire.
#pragma once

#include <cstdint>
#include <string>

#include "Wire.h"

namespace host {

struct PortSettings {
  unsigned long baud = 0;
  uint32_t config = 0;  // bits of stm32l0_uart.h

  Format format() const;
  uint32_t bitNs() const { return bitNsAt(baud); }
  uint64_t characterNs() const { return uint64_t{format().bits()} * bitNs(); }
  uint32_t characterUs() const { return static_cast<uint32_t>(characterNs() / 1000); }

  // True if the port takes for idle what is idle on such a wire.
  bool agreesWith(Polarity polarity) const;

  bool operator==(const PortSettings &other) const { return baud == other.baud && config == other.config; }
};

// The wire at the TX pin of a port with these settings.
Wire wireFrom(const PortSettings &settings);

// In what they differ: "baud rate, format, polarity"; empty if the port is right for the wire.
std::string mismatch(const PortSettings &settings, const Wire &wire);

// "9600 baud, 8N1, not inverted": of the port's RX, and of a wire
std::string text(const PortSettings &settings);
std::string text(const Wire &wire);

}  // namespace host
