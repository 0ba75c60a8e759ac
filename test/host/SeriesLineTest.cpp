// The paper's oscilloscope picture, read bit by bit, and the line helper that reads it.
#include "support/SeriesLine.h"

#include <doctest/doctest.h>

#include "support/KnownFrames.h"
#include "sbus/Frame.h"

namespace {

// The paper, chapter 4.1, as printed: the start bit, then eight times the data bits, and behind each the parity bit,
// two stop bits and the next start bit. Two groups are misprints: 1101 behind 03 (the first stop bit is 1) and 1001
// behind 1F (five ones, so the inverted parity bit must be 0).
const char PaperSeries[] =
    "1 00001111 1001 00111000 0001 00111111 1101 00000111 1001 "
    "00101011 1001 11111100 1001 00011100 0001 10101111 1001";

std::string flipped(std::string bits, size_t index) {
  bits[index] = bits[index] == '0' ? '1' : '0';
  return bits;
}

const std::string Idle(12, '0');

}  // namespace

TEST_CASE("the paper's series frame reads 0F E3 03 1F 2B C0 C7 0A, with one stop bit and one parity bit misprinted") {
  const std::vector<LineCharacter> expected = {
      {0x0F, true, true}, {0xE3, true, true}, {0x03, true, false}, {0x1F, false, true},
      {0x2B, true, true}, {0xC0, true, true}, {0xC7, true, true},  {0x0A, true, true},
  };
  CHECK(decodeLine(PaperSeries) == expected);
}

TEST_CASE("the paper's series frame, completed, decodes to the paper's CH1..CH5") {
  Frame frame = PaperLow.bytes;
  const std::vector<LineCharacter> characters = decodeLine(PaperSeries);
  REQUIRE(characters.size() == 8);
  for (size_t i = 0; i < 8; i++) {
    frame[i] = characters[i].byte;
  }
  Channels channels;
  sbus::unpack(frame.data(), channels.data());
  CHECK(channels[0] == 995);
  CHECK(channels[1] == 992);
  CHECK(channels[2] == 172);
  CHECK(channels[3] == 992);
  CHECK(channels[4] == 172);
}

TEST_CASE("bytes go onto the line as the paper prints them") {
  const struct {
    uint8_t byte;
    const char *bits;
  } rows[] = {
      {0x0F, "100001111100"}, {0xE3, "100111000000"}, {0x2B, "100101011100"},
      {0xC0, "111111100100"}, {0xC7, "100011100000"}, {0x0A, "110101111100"},
  };
  for (const auto &row : rows) {
    CAPTURE(row.byte);
    CHECK(encodeLine(row.byte) == row.bits);
  }
}

TEST_CASE("every byte is read back from the line, with or without a pause in front") {
  for (unsigned value = 0; value < 256; value++) {
    CAPTURE(value);
    const uint8_t byte = static_cast<uint8_t>(value);
    const std::vector<LineCharacter> twice = {{byte, true, true}, {byte, true, true}};
    CHECK(decodeLine(encodeLine(byte) + encodeLine(byte)) == twice);
    CHECK(decodeLine(Idle + encodeLine(byte) + "0" + encodeLine(byte)) == twice);
  }
}

TEST_CASE("one wrong data bit changes that bit and is reported by the parity") {
  for (unsigned value = 0; value < 256; value++) {
    for (unsigned k = 0; k < 8; k++) {
      CAPTURE(value);
      CAPTURE(k);
      const uint8_t byte = static_cast<uint8_t>(value);
      const std::vector<LineCharacter> expected = {{static_cast<uint8_t>(value ^ 1u << k), false, true}};
      CHECK(decodeLine(flipped(encodeLine(byte), 1 + k)) == expected);
    }
  }
}

TEST_CASE("a wrong parity bit or stop bit leaves the byte and is reported") {
  for (unsigned value = 0; value < 256; value++) {
    CAPTURE(value);
    const uint8_t byte = static_cast<uint8_t>(value);
    const std::vector<LineCharacter> wrongParity = {{byte, false, true}};
    const std::vector<LineCharacter> wrongStop = {{byte, true, false}};
    CHECK(decodeLine(flipped(encodeLine(byte), 9)) == wrongParity);
    CHECK(decodeLine(flipped(encodeLine(byte), 10)) == wrongStop);
    CHECK(decodeLine(flipped(encodeLine(byte), 11)) == wrongStop);
  }
}

TEST_CASE("without its start bit no byte is read as itself") {
  for (unsigned value = 0; value < 256; value++) {
    CAPTURE(value);
    const uint8_t byte = static_cast<uint8_t>(value);
    const std::vector<LineCharacter> itself = {{byte, true, true}};
    CHECK(decodeLine(flipped(encodeLine(byte), 0) + Idle) != itself);
  }
}

TEST_CASE("a character that is cut off is not reported") {
  CHECK(decodeLine(encodeLine(0x0F).substr(0, 11)).empty());
  CHECK(decodeLine(Idle).empty());
}
