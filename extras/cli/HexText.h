// Reads bytes as people write them: 0F E3 03, 0FE303, F E3 3, 0x0F, 0xE3, {0x0F, 0xE3}. As in the output of `sbus hex`,
// ! after a byte marks a parity or framing error.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tool {

struct HexText {
  struct Byte {
    uint8_t value;
    bool bad;
  };
  std::vector<Byte> bytes;
  std::string wrong;  // the first word that is not hexadecimal, where reading stops; usually empty
};

// Returns the bytes of the text. Blanks, commas, semicolons, colons, hyphens and braces separate them.
HexText parseHex(std::string_view text);

}  // namespace tool
