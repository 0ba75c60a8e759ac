// The paper's oscilloscope picture, read bit by bit, holds the paper's frame.
#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "sbus/Frame.h"
#include "support/KnownFrames.h"

namespace {

// The paper, chapter 4.1, as printed: the start bit, then eight times the data bits, and after each the parity bit, two
// stop bits and the next start bit. Two groups are misprints: 1101 after 03 (the first stop bit is 1) and 1001 after 1F
// (five ones, so the inverted parity bit must be 0).
const std::string PaperSeries =
    "1 00001111 1001 00111000 0001 00111111 1101 00000111 1001 "
    "00101011 1001 11111100 1001 00011100 0001 10101111 1001";

// 8E2, inverted: a start bit 1, eight data bits, the low one first, an even parity bit, two stop bits 0; the data and
// the parity bit are inverted.
struct Printed {
  unsigned value = 0;
  bool parityRight = false;
  bool stopsRight = false;
};

std::vector<Printed> read(std::string bits) {
  bits.erase(std::remove(bits.begin(), bits.end(), ' '), bits.end());
  std::vector<Printed> characters;
  for (size_t at = 0; at + 12 <= bits.size(); at += 12) {
    REQUIRE(bits[at] == '1');
    Printed character;
    bool odd = false;
    for (unsigned k = 0; k < 8; k++) {
      const bool one = bits[at + 1 + k] == '0';
      character.value |= one ? 1u << k : 0u;
      odd = odd != one;
    }
    character.parityRight = (bits[at + 9] == '0') == odd;
    character.stopsRight = bits.compare(at + 10, 2, "00") == 0;
    characters.push_back(character);
  }
  return characters;
}

}  // namespace

TEST_CASE("the paper's series frame reads 0F E3 03 1F 2B C0 C7 0A, with one stop bit and one parity bit misprinted") {
  const std::vector<Printed> characters = read(PaperSeries);
  REQUIRE(characters.size() == 8);
  Frame frame = PaperLow.bytes;
  for (size_t i = 0; i < 8; i++) {
    CAPTURE(i);
    CHECK(characters[i].value == PaperLow.bytes[i]);
    CHECK(characters[i].stopsRight == (i != 2));
    CHECK(characters[i].parityRight == (i != 3));
    frame[i] = static_cast<uint8_t>(characters[i].value);
  }
  Channels channels;
  sbus::unpack(frame.data(), channels.data());
  const uint16_t printed[] = {995, 992, 172, 992, 172};
  for (size_t i = 0; i < 5; i++) {
    CHECK(channels[i] == printed[i]);
  }
}
