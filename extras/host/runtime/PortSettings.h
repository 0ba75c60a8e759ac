// What a sketch has set a port to, and what a line needs.
#pragma once

#include <cstdint>
#include <string>

namespace host {

struct PortSettings {
  unsigned long baud = 0;
  uint32_t config = 0;  // bits of stm32l0_uart.h
};

// True if a port with these settings understands S.Bus. `inverted`: the wire has the levels of S.Bus, see Line.
bool understandsSBus(const PortSettings &settings, bool inverted);

// "9600 baud, 8N1, not inverted"
std::string text(const PortSettings &settings);

}  // namespace host
