// The wire between a sender and a port: how fast its bits are, which way up, and what a character is made of. Idle
// between characters.
#pragma once

#include <algorithm>
#include <cstdint>

#include "sbus/Frame.h"

namespace host {

enum class Polarity {
  Inverted,    // S.Bus: idle is LOW
  Uninverted,  // a receiver's uninverted pad, or an inverter in between: idle is HIGH
  Either,      // nobody knows what stands in between, and it does what the port wants
};

enum class Parity { None, Even, Odd };

// A character: a start bit, then these.
struct Format {
  unsigned dataBits = 8;
  Parity parity = Parity::Even;
  unsigned stopBits = 2;

  unsigned parityBits() const { return parity == Parity::None ? 0 : 1; }
  unsigned bits() const { return 1 + dataBits + parityBits() + stopBits; }
  bool operator==(const Format &other) const {
    return dataBits == other.dataBits && parity == other.parity && stopBits == other.stopBits;
  }
};

// A bit at a rate that may be anything that a sketch hands over, 0 too.
inline uint32_t bitNsAt(unsigned long baud) {
  constexpr unsigned long SecondNs = 1000000000;
  return static_cast<uint32_t>(SecondNs / std::clamp(baud, 1ul, SecondNs));
}

// 8E2 unless a sketch sends with other settings: all receivers do.
struct Wire {
  unsigned long baud = sbus::Baud;  // or 200000, Fast S.Bus
  Polarity polarity = Polarity::Inverted;
  Format format{};

  uint32_t bitNs() const { return bitNsAt(baud); }
  uint32_t characterUs() const { return static_cast<uint32_t>(uint64_t{format.bits()} * bitNs() / 1000); }
  bool operator==(const Wire &other) const {
    return baud == other.baud && polarity == other.polarity && format == other.format;
  }
};

}  // namespace host
