// The settings of a line or a port: baud rate, polarity and format of a character.
#pragma once

#include <cstdint>
#include <string>

#include "sbus/Frame.h"

namespace line {

enum class Polarity {
  Inverted,    // S.Bus: idle is LOW
  Uninverted,  // a receiver's uninverted pad, or an inverter in between: idle is HIGH
  Either,      // for a line only: unknown, and assumed to be what the port expects
};

enum class Parity { None, Even, Odd };

// Returns true if the number of ones is odd: even parity then adds a one.
bool isOdd(unsigned bits);

// The bits of a character after its start bit.
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

// Default: S.Bus.
struct LineSettings {
  unsigned long baud = sbus::Baud;  // 200000 for Fast S.Bus; a sketch may set any number, even 0
  Polarity polarity = Polarity::Inverted;
  Format format{};

  bool idleHigh() const { return polarity == Polarity::Uninverted; }
  uint32_t bitNs() const;
  uint64_t characterNs() const { return uint64_t{format.bits()} * bitNs(); }
  uint32_t characterUs() const { return static_cast<uint32_t>(characterNs() / 1000); }
  bool operator==(const LineSettings &other) const {
    return baud == other.baud && polarity == other.polarity && format == other.format;
  }
};

// Returns the differences, "baud rate, format, polarity"; empty if the port's settings are right for the line.
std::string mismatch(const LineSettings &port, const LineSettings &line);

// Returns "9600 baud, 8N1, not inverted".
std::string text(const LineSettings &settings);

}  // namespace line
