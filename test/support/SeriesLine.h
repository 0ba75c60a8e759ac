// The line as an oscilloscope shows it: 8E2, inverted. Idle is 0; a character is a start bit 1, eight data bits least
// significant first, an even parity bit and two stop bits 0, the data and the parity bit inverted: 12 bits.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

struct LineCharacter {
  uint8_t byte;
  bool parityRight;
  bool stopsRight;

  bool operator==(const LineCharacter &other) const {
    return byte == other.byte && parityRight == other.parityRight && stopsRight == other.stopsRight;
  }
};

inline bool isOddParity(uint8_t byte) {
  return __builtin_parity(byte) == 1;
}

// The 12 bits of one character, as '0' and '1'.
inline std::string encodeLine(uint8_t byte) {
  std::string bits = "1";
  for (unsigned k = 0; k < 8; k++) {
    bits += (byte >> k & 1) != 0 ? '0' : '1';
  }
  bits += isOddParity(byte) ? '0' : '1';
  return bits + "00";
}

// The characters in `bits`; anything but '0' and '1' is there for the eye. A character cut off at the end is left out.
inline std::vector<LineCharacter> decodeLine(const std::string &bits) {
  std::string line;
  for (const char bit : bits) {
    if (bit == '0' || bit == '1') {
      line += bit;
    }
  }
  std::vector<LineCharacter> characters;
  size_t at = line.find('1');
  while (at != std::string::npos && at + 12 <= line.size()) {
    unsigned byte = 0;
    for (unsigned k = 0; k < 8; k++) {
      byte |= line[at + 1 + k] == '0' ? 1u << k : 0u;
    }
    const bool odd = line[at + 9] == '0';
    characters.push_back({static_cast<uint8_t>(byte), odd == isOddParity(static_cast<uint8_t>(byte)),
                          line.compare(at + 10, 2, "00") == 0});
    at = line.find('1', at + 12);
  }
  return characters;
}
