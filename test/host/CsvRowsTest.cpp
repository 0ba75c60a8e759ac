// The rows of numbers that a sketch prints: told from anything else, and read.
#include <doctest/doctest.h>

#include "line/CsvRows.h"
#include "line/SimulatedReceiver.h"

using line::CsvRows;

namespace {

bool recognised(const std::string &text) {
  CsvRows rows;
  for (const char c : text) {
    rows.put(static_cast<uint8_t>(c));
  }
  return rows.recognised();
}

}  // namespace

TEST_CASE("rows are read: values and their text") {
  CsvRows rows;
  size_t count = 0;
  for (const char c : std::string("172,-1.5,0\r\n1811,+3,1\n7")) {
    count += rows.put(static_cast<uint8_t>(c));
  }
  REQUIRE(count == 2);
  REQUIRE(rows.row().size() == 3);
  CHECK(rows.isRow());
  CHECK(rows.row()[0].value == 1811);
  CHECK(rows.row()[1].value == 3);
  CHECK(rows.row()[1].text == "+3");
}

TEST_CASE("what is a sketch's text, and what is not") {
  const struct {
    const char *text;
    bool is;
  } cases[] = {
      {"1,2,3,4,0,0\r\n1,2,3,4,0,0\r\n", true},
      {"0.732,0.469\n-0.675,0.369\n", true},
      {"3,4,0,0\r\n1,2,3,4,0,0\r\n1,2,3,4,0,0\r\n", true},  // from the middle of a row on
      {"1,2,3,4,0,0\r\n1,2,3,4,0,0", false},                // the second is not complete
      {"1,2,3,4,0,0\r\n", false},
      {"1,2,3\n1,2\n", false},
      {"120\n240\n", false},  // a number alone says nothing
      {"PASS: 100 frames sent\nPASS: 100 frames sent\n", false},
      {"1,,3\n1,,3\n", false},
      {"0x1,2\n0x1,2\n", false},
      {"inf,2\ninf,2\n", false},
      {"1,2\n1,2\n\x0F", false},
      {"1,2\x0F\n1,2\n", false},
      {"\n\n", false},
  };
  for (const auto &each : cases) {
    CAPTURE(each.text);
    CHECK(recognised(each.text) == each.is);
  }
}

TEST_CASE("S.Bus is never taken for it") {
  for (const line::Channels channels :
       {line::Channels::Sixteen, line::Channels::TwentyFour, line::Channels::ThirtyTwo}) {
    line::SimulatedReceiver receiver(line::Flight, line::CharacterUs, channels);
    CsvRows rows;
    for (line::Character character; receiver.next(15000000, character);) {
      rows.put(character);
      REQUIRE_FALSE(rows.recognised());
    }
  }
}

TEST_CASE("a bad character is no text") {
  CsvRows rows;
  for (const char c : std::string("1,2\n1,2\n")) {
    line::Character character;
    character.value = static_cast<uint8_t>(c);
    rows.put(character);
  }
  CHECK(rows.recognised());
  line::Character bad;
  bad.value = '1';
  bad.bad = true;
  rows.put(bad);
  CHECK_FALSE(rows.recognised());
}

TEST_CASE("a line without an end is not kept") {
  CsvRows rows;
  for (size_t i = 0; i < 100000; i++) {
    rows.put(i % 2 == 0 ? '1' : ',');
  }
  REQUIRE(rows.put('\n'));
  CHECK(rows.row().size() == 64);
}

TEST_CASE("what columns are called") {
  CHECK(line::csvName(0, 6) == "CH1");
  CHECK(line::csvName(4, 6) == "failsafe");
  CHECK(line::csvName(5, 6) == "lostFrame");
  CHECK(line::csvName(5, 18) == "CH6");
  CHECK(line::csvName(23, 24) == "CH24");
}
