// The rows of numbers that a sketch prints: they are recognised among other text, and read.
#include <doctest/doctest.h>

#include "line/recording/CsvRows.h"
#include "line/simulation/SimulatedReceiver.h"

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

TEST_CASE("rows of a German spreadsheet are read: semicolons or tabs, and decimal commas") {
  for (const char *text : {"time;CH1\n0,009;1500,5\n", "time\tCH1\n0,009\t1500,5\n", "0,009; 1500,5;\n",
                           "t:0,009;x:1500,5\n", "0.009,\t1500.5\n", "0.009\t1500.5\t\n"}) {
    CAPTURE(text);
    CsvRows rows;
    for (const char c : std::string(text)) {
      rows.put(static_cast<uint8_t>(c));
    }
    REQUIRE(rows.row().size() >= 2);
    CHECK(rows.row()[0].value == 0.009);
    CHECK(rows.row()[1].value == 1500.5);
  }
}

TEST_CASE("a sketch's rows are recognised, and other text is not") {
  const struct {
    const char *text;
    bool is;
  } cases[] = {
      {"1,2,3,4,0,0\r\n1,2,3,4,0,0\r\n", true},
      {"0.732,0.469\n-0.675,0.369\n", true},
      {"995,992,172,992,0,0\r995,993,1811,992,0,0\r", true},  // as the paper's sketch ends them
      {"3,4,0,0\r\n1,2,3,4,0,0\r\n1,2,3,4,0,0\r\n", true},    // from the middle of a row on
      {"1,2,3,4,0,0\r\n1,2,3,4,0,0", false},                  // the second is not complete
      {"1,2,3,4,0,0\r\n", false},
      {"1,2,3\n1,2\n", false},
      {"120\n240\n", false},  // a number alone proves nothing
      {"PASS: 100 frames sent\nPASS: 100 frames sent\n", false},
      {"1,,3\n1,,3\n", false},
      {"0x1,2\n0x1,2\n", false},
      {"inf,2\ninf,2\n", false},
      {"1,2\n1,2\n\x0F", false},
      {"1,2\x0F\n1,2\n", false},
      {"\n\n", false},
      {"1500 1000 0\n1501 1000 0\n", true},
      {" 1500  1000 0 \r\n1501 1000 0\r\n", true},
      {"1500\t1000\t\r\n1501\t1000\t\r\n", true},  // each number with a tab behind it
      {"1, 2, 3\n1, 2, 3\n", true},
      {"1;2;3\n1;2;3\n", true},
      {"0,1;2\n0,2;2\n", true},
      {"0,1\t2\n0,2\t2\n", true},
      {"1,\t2,\t3\n1,\t2,\t3\n", true},
      {"1;;3\n1;;3\n", false},
      {"1,2,\n1,2,\n", false},
      {"throttle:172,roll:992\nthrottle:173,roll:991\n", true},
      {"throttle:172 roll:992\nthrottle:173 roll:991\n", true},
      {"throttle:,roll:992\nthrottle:,roll:991\n", false},
      {"1\t\t3\n1\t\t3\n", false},
  };
  for (const auto &each : cases) {
    CAPTURE(each.text);
    CHECK(recognised(each.text) == each.is);
  }
}

TEST_CASE("S.Bus is never taken for rows of a sketch") {
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

TEST_CASE("a character with an error is no text") {
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

TEST_CASE("a line that does not end is not stored") {
  CsvRows rows;
  for (size_t i = 0; i < 100000; i++) {
    rows.put(i % 2 == 0 ? '1' : ',');
  }
  REQUIRE(rows.put('\n'));
  CHECK(rows.row().size() == 64);
}

TEST_CASE("the columns of a row are channels, flags or switches, by their names or number") {
  using line::CsvKind;
  const struct {
    const char *text;
    size_t column;
    CsvKind kind;
  } cases[] = {
      {"1,2,3,4,0,1\n", 3, CsvKind::Channel},
      {"1,2,3,4,0,1\n", 4, CsvKind::Failsafe},
      {"1,2,3,4,0,1\n", 5, CsvKind::LostFrame},
      {"1,2,3,4,5,1\n", 5, CsvKind::Channel},
      {"1,2,3,4,0,0.5\n", 4, CsvKind::Channel},
      {"1,2,3,4,0,7\n1,2,3,4,0,1\n", 5, CsvKind::Channel},  // 7 has stood there
      {"1,2,3,4,0,1,7\n1,2,3,4,0,1\n", 5, CsvKind::LostFrame},
      {"1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,0,1\n", 15, CsvKind::Channel},
      {"1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,0,1\n", 16, CsvKind::Switch17},
      {"1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,0,1\n", 17, CsvKind::Switch18},
      {"1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17,1\n", 17, CsvKind::Channel},
      {"1,2,3,4,0\n", 4, CsvKind::Channel},
      {"CH1,failsafe\n5,1\n", 0, CsvKind::Channel},
      {"CH1,failsafe\n5,1\n", 1, CsvKind::Failsafe},
      {"CH1,lostFrame\n5,1\n", 1, CsvKind::LostFrame},
      {"CH1,lostframe\n5,1\n", 1, CsvKind::LostFrame},  // as sbus csv writes it
      {"CH1,failsafe\n5,1,1\n", 1, CsvKind::Channel},   // names of another table
      {"CH1,CH2,CH3,CH4,CH5,CH6\n1,2,3,4,0,1\n", 5, CsvKind::Channel},
      {"a:1,failsafe:1\n", 1, CsvKind::Failsafe},
      {"a:1,b:2,c:3,d:4,e:0,f:1\n", 5, CsvKind::Channel},
      {"CH17:1,CH18:0\n", 0, CsvKind::Switch17},
      {"CH17:1,CH18:0\n", 1, CsvKind::Switch18},
      {"CH1,CH17,CH18\n5,0,1\n", 2, CsvKind::Switch18},
      {"CH16,CH17,CH18,CH19\n5,6,7,8\n", 1, CsvKind::Channel},  // of 24 channels
      {"CH17:5,CH18:6,CH19:7\n", 1, CsvKind::Channel},
  };
  for (const auto &each : cases) {
    CAPTURE(each.text);
    CAPTURE(each.column);
    CsvRows rows;
    for (const char c : std::string(each.text)) {
      rows.put(static_cast<uint8_t>(c));
    }
    CHECK(rows.kind(each.column) == each.kind);
  }
}

TEST_CASE("a name stands before its number") {
  CsvRows rows;
  for (const char c : std::string("throttle: 172, roll:-5.5\n")) {
    rows.put(static_cast<uint8_t>(c));
  }
  REQUIRE(rows.row().size() == 2);
  CHECK(rows.row()[0].name == "throttle");
  CHECK(rows.row()[0].text == "172");
  CHECK(rows.row()[1].name == "roll");
  CHECK(rows.row()[1].value == -5.5);
}
