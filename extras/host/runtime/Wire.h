// The wire between receiver and port: how fast its bits are, and which way up. The format is always 8E2, idle between
// characters.
#pragma once

#include <cstdint>

#include "sbus/Frame.h"

namespace host {

enum class Polarity {
  Inverted,    // S.Bus: idle is LOW
  Uninverted,  // a receiver's uninverted pad, or an inverter in between: idle is HIGH
  Either,      // nobody knows what stands in between, and it does what the port wants
};

struct Wire {
  unsigned long baud = sbus::Baud;  // or 200000, Fast S.Bus
  Polarity polarity = Polarity::Inverted;

  uint32_t bitNs() const { return static_cast<uint32_t>(1000000000 / baud); }
  uint32_t characterUs() const { return static_cast<uint32_t>(sbus::BitsPerCharacter * 1000000 / baud); }
};

}  // namespace host
