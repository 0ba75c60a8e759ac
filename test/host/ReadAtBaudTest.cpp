// S.Bus that a port has read at 115200 or 57600 baud, 8N1, is recognised by its bytes; other lines are not.
#include <doctest/doctest.h>

#include <random>
#include <string>
#include <vector>

#include "line/ReadAtBaud.h"
#include "line/Source.h"
#include "line/file/FileHead.h"
#include "line/recording/CsvRows.h"
#include "line/uart/SampledLine.h"

namespace {

// Returns what a port reads of `source` for 3 s at another rate, uninverted like a port behind an inverter.
std::string bytesAt(const std::string &source, unsigned long baud) {
  const line::Source from = line::parseSource(source);
  line::LineSettings port = line::csvSettings();
  port.baud = baud;
  port.polarity = from.settings.polarity;
  line::SampledLine line(from.open(), from.settings, port);
  std::string bytes;
  line.opened(0);
  for (uint64_t us = 0; us < 3000000; us += 1000) {
    for (line::Character character; line.next(us, character);) {
      bytes += static_cast<char>(character.value);
    }
  }
  return bytes;
}

unsigned long readAt(const std::string &source, unsigned long baud) {
  line::ReadAtBaud found;
  for (const char c : bytesAt(source, baud)) {
    found.put(static_cast<uint8_t>(c));
  }
  return found.baud();
}

}  // namespace

TEST_CASE("S.Bus read at 115200 and 57600 baud is recognised; at other rates, and other lines, it is not") {
  for (const std::string source : {"sim", "sim:24", "sim:noise=30", "sim:sbus2", "sim:32"}) {
    CAPTURE(source);
    CHECK(readAt(source, 115200) == 115200);
    CHECK(readAt(source, 57600) == 57600);
    std::string file = bytesAt(source, 57600);
    for (const size_t least :
         {size_t{0}, 2 * line::FileHeadMax}) {  // a file of such bytes is no error, so doctor names it
      while (file.size() < least) {
        file += file;
      }
      const line::FileHead head = line::readFileHead(file.substr(0, line::FileHeadMax), "file");
      CHECK(head.kind == line::FileKind::Bytes);
      CHECK(head.damage == "Wrong baud rate: these are frames of S.Bus that a port has read at 57600 baud.");
    }
  }
  for (const unsigned long baud : {100000ul, 200000ul, 38400ul, 76800ul, 230400ul}) {
    CAPTURE(baud);
    CHECK(readAt("sim", baud) == 0);
  }
  for (const std::string source : {"sim:24", "sim:sbus2", "sim:32"}) {
    for (const unsigned long baud : {100000ul, 200000ul, 38400ul}) {
      CAPTURE(source);
      CHECK(readAt(source, baud) == 0);
    }
  }
  CHECK(readAt("sim:noise=1000", 100000) == 0);
}

TEST_CASE("ten frames in a row are needed, each of a frame's length, and no text in them; telemetry may come between") {
  const auto baudOf = [](uint8_t header, unsigned headers, unsigned size, uint8_t rest = 0xE0, unsigned every = 1000) {
    line::ReadAtBaud found;
    for (unsigned i = 0; i < headers; i++) {
      found.put(header);
      for (unsigned at = 1; at < size + (i % every == every - 1 ? 60 : 0); at++) {
        found.put(at == 3 && every < 1000 ? header : at < size ? rest : uint8_t{0xFA});
      }
    }
    return found.baud();
  };
  CHECK(baudOf(0x1F, 10, 26) == 0);
  CHECK(baudOf(0x1F, 11, 26) == 115200);
  CHECK(baudOf(0x5F, 12, 26) == 115200);
  CHECK(baudOf(0x1E, 99, 26) == 0);
  CHECK(baudOf(0x1F, 99, 45) == 115200);
  CHECK(baudOf(0x1F, 99, 46) == 0);
  CHECK(baudOf(0xA3, 12, 9) == 0);
  CHECK(baudOf(0xA3, 12, 10) == 57600);
  CHECK(baudOf(0x63, 99, 24) == 57600);
  CHECK(baudOf(0xF7, 99, 24) == 57600);
  CHECK(baudOf(0x63, 99, 25) == 0);
  CHECK(baudOf('c', 99, 16, ' ') == 0);  // text
  CHECK(baudOf(0x63, 99, 16, 0xE0, 4) == 57600);
  CHECK(baudOf(0x63, 99, 16, 0xE0, 2) == 0);
}

TEST_CASE("the line of an R7003SB is recognised, whose frames have a tail") {
  const struct {
    unsigned long baud;
    std::vector<uint8_t> frame;
  } rows[] = {
      {115200, {0x1F, 0xC2, 0xD3, 0x13, 0xDE, 0xBC, 0xED, 0x0C, 0x80, 0x00, 0x02, 0x20, 0x00, 0x00, 0x0C, 0x40,
                0x00, 0x01, 0x10, 0x80, 0x00, 0x02, 0x20, 0x00, 0x00, 0x10, 0x00, 0x03, 0x80, 0x33, 0x1C}},
      {57600,
       {0x63, 0xA5, 0xB4, 0x9A, 0x30, 0x81, 0x8C, 0x30, 0x30, 0x03, 0x30, 0x86, 0xA0, 0x30, 0x20, 0x06, 0x21, 0xD3}}};
  for (const auto &row : rows) {
    line::ReadAtBaud found;
    for (int i = 0; i < 13; i++) {
      for (const uint8_t byte : row.frame) {
        found.put(byte);
      }
    }
    CHECK(found.baud() == row.baud);
  }
}

TEST_CASE("frames among ten times as many other bytes are no line at another rate") {
  line::ReadAtBaud found;
  for (unsigned i = 0; i < 20; i++) {
    found.put(0xE0);
    found.put(0x1F);
    for (unsigned at = 2; at < 26; at++) {
      found.put(0xA5);
    }
  }
  CHECK(found.baud() == 115200);
  for (unsigned i = 0; i < 20 * 26 * 10; i++) {
    found.put(0xA5);
  }
  CHECK(found.baud() == 0);
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
