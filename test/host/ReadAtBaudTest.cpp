// S.Bus that a port has read at 115200 or 57600 baud, 8N1, is recognised by its bytes; other lines are not.
#include <doctest/doctest.h>

#include <random>

#include "line/ReadAtBaud.h"
#include "line/Source.h"
#include "line/recording/CsvRows.h"
#include "line/uart/SampledLine.h"

namespace {

// Reads `source` for 3 s at another rate, uninverted like a port behind an inverter.
unsigned long readAt(const char *source, unsigned long baud) {
  const line::Source from = line::parseSource(source);
  line::LineSettings port = line::csvSettings();
  port.baud = baud;
  port.polarity = from.settings.polarity;
  line::SampledLine line(from.open(), from.settings, port);
  line::ReadAtBaud found;
  line.opened(0);
  for (uint64_t us = 0; us < 3000000; us += 1000) {
    for (line::Character character; line.next(us, character);) {
      found.put(character.value);
    }
  }
  return found.baud();
}

}  // namespace

TEST_CASE("S.Bus read at 115200 and 57600 baud is recognised; at other rates, and other lines, it is not") {
  CHECK(readAt("sim", 115200) == 115200);
  CHECK(readAt("sim:32", 115200) == 0);  // header 2F comes between
  CHECK(readAt("sim", 57600) == 57600);
  for (const unsigned long baud : {100000, 200000, 38400, 76800, 230400}) {
    CAPTURE(baud);
    CHECK(readAt("sim", baud) == 0);
  }
  CHECK(readAt("sim:24", 100000) == 0);
  CHECK(readAt("sim:sbus2", 100000) == 0);
  CHECK(readAt("sim:noise=1000", 100000) == 0);
}

TEST_CASE("eight frames in a row are needed, each of a frame's length") {
  const auto baudOf = [](unsigned headers, unsigned between) {
    line::ReadAtBaud found;
    for (unsigned i = 0; i < headers; i++) {
      found.put(0x1F);
      for (unsigned at = 0; at < between; at++) {
        found.put(0x00);
      }
    }
    return found.baud();
  };
  CHECK(baudOf(8, 25) == 0);
  CHECK(baudOf(9, 25) == 115200);  // of the first it is not known how long ago the one before was
  CHECK(baudOf(99, 18) == 0);
  CHECK(baudOf(99, 19) == 115200);
  CHECK(baudOf(99, 31) == 115200);
  CHECK(baudOf(99, 32) == 0);
}

TEST_CASE("random bytes are no line at another rate") {
  constexpr unsigned Seed = 20181;
  std::mt19937 random(Seed);
  CAPTURE(Seed);
  line::ReadAtBaud found;
  for (unsigned i = 0; i < 1000000; i++) {
    const uint8_t often[] = {0x00, 0x1F, 0x20, 0xE3};
    found.put(random() % 4 != 0 ? static_cast<uint8_t>(random()) : often[random() % 4]);
  }
  CHECK(found.baud() == 0);
}
