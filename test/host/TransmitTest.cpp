// The host's board as a sender: its transmit buffer, and what a port with other settings receives.
#include <doctest/doctest.h>

#include <vector>

#include "SerialConfig.h"
#include "support/ShowArrays.h"
#include "board/BoardTransmitter.h"
#include "board/PortSettings.h"
#include "line/uart/UartSampler.h"
#include "stm32l0_uart.h"

using host::BoardTransmitter;
using line::Character;

namespace {

constexpr uint64_t SBusNs = 120000;

// Bytes 0, 1, 2 and so on.
std::vector<uint8_t> counting(size_t size) {
  std::vector<uint8_t> bytes;
  for (size_t i = 0; i < size; i++) {
    bytes.push_back(static_cast<uint8_t>(i));
  }
  return bytes;
}

size_t write(BoardTransmitter &transmitter, uint64_t nowUs, size_t size) {
  return transmitter.write(nowUs, counting(size).data(), size);
}

std::vector<Character> sentBy(BoardTransmitter &transmitter, uint64_t nowUs) {
  std::vector<Character> characters;
  for (Character character; transmitter.next(nowUs, character);) {
    characters.push_back(character);
  }
  return characters;
}

// Returns what a port with settings `to` receives of bytes that a port with settings `from` sends back to back.
std::vector<Character> heard(const host::PortSettings &from, const host::PortSettings &to,
                             const std::vector<uint8_t> &bytes) {
  BoardTransmitter transmitter;
  transmitter.open(from.tx.characterNs());
  transmitter.write(1000, bytes.data(), bytes.size());
  line::UartSampler sampler;
  sampler.open(0, to.rx, from.tx);
  constexpr uint64_t LongAfterUs = 1000000;
  for (const Character &character : sentBy(transmitter, LongAfterUs)) {
    sampler.put(character);
  }
  std::vector<Character> characters;
  for (Character character; sampler.next(LongAfterUs, character);) {
    characters.push_back(character);
  }
  return characters;
}

// Returns how many of the sent bytes arrive, in order: those a sketch could use.
size_t bytesThrough(const host::PortSettings &from, const host::PortSettings &to) {
  const std::vector<uint8_t> bytes = counting(64);
  size_t through = 0;
  for (const Character &character : heard(from, to, bytes)) {
    through += !character.bad && through < bytes.size() && character.value == bytes[through];
  }
  return through;
}

}  // namespace

TEST_CASE("a closed port has no room and takes nothing; closing it loses the characters that are being sent") {
  BoardTransmitter transmitter;
  CHECK(transmitter.availableForWrite() == 0);
  CHECK(write(transmitter, 0, 1) == 0);
  transmitter.open(SBusNs);
  CHECK(transmitter.availableForWrite() == 64);
  CHECK(write(transmitter, 0, 25) == 25);
  transmitter.close();
  CHECK(transmitter.idle());
  CHECK(transmitter.availableForWrite() == 0);
  CHECK(sentBy(transmitter, 1000000).empty());
  transmitter.open(SBusNs);
  CHECK(sentBy(transmitter, 1000000).empty());
}

TEST_CASE("characters go out back to back, the first one character time after it was written") {
  for (const uint64_t ns : {uint64_t{120000}, uint64_t{60000}}) {
    CAPTURE(ns);
    BoardTransmitter transmitter;
    transmitter.open(ns);
    REQUIRE(write(transmitter, 5000, 25) == 25);
    const std::vector<Character> characters = sentBy(transmitter, 1000000);
    REQUIRE(characters.size() == 25);
    for (size_t i = 0; i < 25; i++) {
      CHECK(characters[i].value == i);
      CHECK(characters[i].endUs == 5000 + (i + 1) * ns / 1000);
      CHECK_FALSE(characters[i].bad);
    }
    CHECK(transmitter.idle());
  }
}

TEST_CASE("a character counts as sent at its end, not a microsecond before, and rounded times do not add up") {
  BoardTransmitter transmitter;
  transmitter.open(86805);  // 10 bits at 115200 baud
  write(transmitter, 0, 64);
  CHECK(sentBy(transmitter, 86).empty());
  CHECK(sentBy(transmitter, 87).size() == 1);
  CHECK(sentBy(transmitter, 5555).size() == 62);
  CHECK(sentBy(transmitter, 5556).size() == 1);  // the 64th: 5555.52 us
}

TEST_CASE("a place becomes free when its character has been sent") {
  BoardTransmitter transmitter;
  transmitter.open(SBusNs);
  REQUIRE(write(transmitter, 0, 50) == 50);
  CHECK(transmitter.nextUs() == 120);
  sentBy(transmitter, 31 * 120);
  CHECK(transmitter.availableForWrite() == 14 + 31);
  CHECK(transmitter.nextUs() == 32 * 120);
  sentBy(transmitter, 50 * 120);
  CHECK(transmitter.availableForWrite() == 64);
  CHECK(transmitter.nextUs() == 0);
}

TEST_CASE("characters that have begun come once each, at their start") {
  BoardTransmitter transmitter;
  transmitter.open(SBusNs);
  write(transmitter, 0, 2);
  Character character;
  CHECK(transmitter.begun(0, character));
  CHECK(character.endUs == 120);
  CHECK_FALSE(transmitter.begun(119, character));
  CHECK(sentBy(transmitter, 120).size() == 1);
  CHECK(transmitter.begun(120, character));
  CHECK(character.value == 1);
  CHECK(character.endUs == 240);
  CHECK_FALSE(transmitter.begun(1000, character));
}

TEST_CASE(
    "a full buffer takes what fits; bytes written in time follow without a gap, later ones when they are written") {
  BoardTransmitter transmitter;
  transmitter.open(SBusNs);
  CHECK(write(transmitter, 0, 70) == 64);
  CHECK(write(transmitter, 0, 1) == 0);
  CHECK(sentBy(transmitter, 32 * 120).size() == 32);
  CHECK(write(transmitter, 32 * 120, 6) == 6);
  const std::vector<Character> rest = sentBy(transmitter, 8400);
  REQUIRE(rest.size() == 38);
  CHECK(rest.back().endUs == 70 * 120);
  CHECK(rest.back().value == 5);
  write(transmitter, 9000, 1);  // after a gap
  const std::vector<Character> late = sentBy(transmitter, 20000);
  REQUIRE(late.size() == 1);
  CHECK(late[0].endUs == 9120);
}

TEST_CASE(
    "between ports with the same settings every byte arrives, in any format and at any rate; of seven bits the low "
    "ones") {
  constexpr uint32_t SevenBits = STM32L0_UART_OPTION_DATA_SIZE_7 | STM32L0_UART_OPTION_PARITY_EVEN;
  const std::vector<uint8_t> bytes = {0x00, 0xFF, 0x0F, 0x55, 0xAA, 0x01, 0x80, 0x7F};
  for (const unsigned long baud : {9600ul, 100000ul, 115200ul, 200000ul}) {
    for (const uint32_t config : std::initializer_list<uint32_t>{SERIAL_SBUS, SERIAL_8E2, SERIAL_8E1, SERIAL_8N1,
                                                                 SERIAL_8N2, SERIAL_8O1, SERIAL_8O2, SevenBits}) {
      const bool seven = config == SevenBits;
      INFO("baud ", baud, ", config ", config);
      const host::PortSettings settings = host::portSettings(baud, config);
      const std::vector<Character> characters = heard(settings, settings, bytes);
      REQUIRE(characters.size() == bytes.size());
      for (size_t i = 0; i < bytes.size(); i++) {
        CHECK(characters[i].value == (seven ? bytes[i] & 0x7F : bytes[i]));
        CHECK_FALSE(characters[i].bad);
      }
    }
  }
}

TEST_CASE("with another parity, rate or polarity hardly a byte arrives; with a stop bit less, every byte does") {
  const uint32_t inverted = STM32L0_UART_OPTION_RX_INVERT | STM32L0_UART_OPTION_TX_INVERT;
  const host::PortSettings sBus = host::portSettings(100000, SERIAL_SBUS);
  const struct {
    unsigned long baud;
    uint32_t config;
    bool through;
  } rows[] = {
      {100000, SERIAL_SBUS, true},  {100000, SERIAL_8E1 | inverted, true}, {100000, SERIAL_8O2 | inverted, false},
      {200000, SERIAL_SBUS, false}, {100000, SERIAL_8E2, false},           {200000, SERIAL_8E2, false},
      {9600, SERIAL_SBUS, false}};
  for (const auto &row : rows) {
    INFO("baud ", row.baud, ", config ", row.config);
    const host::PortSettings other = host::portSettings(row.baud, row.config);
    CHECK((bytesThrough(sBus, other) == 64) == row.through);
    CHECK((bytesThrough(sBus, other) <= 1) != row.through);
    CHECK((row.through || bytesThrough(other, sBus) <= 1));
  }
}
