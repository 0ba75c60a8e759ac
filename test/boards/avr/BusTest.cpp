// Runs sketches that answer on an S.BUS2 line, on a simulated Mega, and on a Leonardo, which has no timer 2.
#include <doctest/doctest.h>

#include <regex>
#include <string>

#include "AvrBoard.h"
#include "Expected.h"
#include "line/Source.h"

namespace {

using avr::AvrBoard;

constexpr unsigned BusySeconds = 12;  // 60 for ten thousand answers

avr::Line bus() {
  line::Source source;
  source.sbus2 = true;
  avr::Line line;
  line.source = source.open();
  line.isShared = true;
  return line;
}

// An answer that is wrong in any way makes the report longer.
unsigned long answers(const AvrBoard &board) {
  const std::string report = board.report();
  MESSAGE(report);
  std::smatch right;
  const std::regex all("on the S.BUS2 wire: ([0-9]+) answers in their slots, .* us off");
  return std::regex_match(report, right, all) ? std::stoul(right[1]) : 0;
}

}  // namespace

TEST_CASE("Sensor answers on an S.BUS2 line, in its slots") {
  for (const avr::Model &model : {avr::Mega, avr::Leonardo}) {
    CAPTURE(std::string(model.name));
    const AvrBoard board(model, "Sensor", bus(), 12);
    CHECK(answers(board) >= 12000 / 60 * 5 * 9 / 10);
    CHECK(board.sent().size() / 3 <= answers(board) + 1);  // the last one may be under way
    REQUIRE(board.printed().size() == 11);
    CHECK(board.printed().back().text.find("collisions:0") != std::string::npos);
    CHECK(board.mistakes() == "");
  }
}

TEST_CASE(
    "while loop() writes a sensor for 3 ms, eleven slots are answered, and no frame is lost; "
    "end() restores timer 4; a tone() sounds meanwhile") {
  const AvrBoard board(avr::Mega, "Busy", bus(), BusySeconds);
  CHECK(answers(board) >= BusySeconds * 1000 / 60 * 11 * 9 / 10);
  CHECK(board.mistakes() == "");
  const avr::Numbers last = avr::numbersIn(board.printed().back().text);
  REQUIRE(last.size() == 7);
  MESSAGE(board.printed().back().text);
  CHECK(last[0] >= static_cast<double>(board.printed().back().us) / 15000 - 3);  // the first one begins at 5 ms
  CHECK(last[1] == 0);
  CHECK(last[2] == 0);
  CHECK(last[3] == 0);
  CHECK(last[4] < BusySeconds * 10 + 17 * 11 / 4);  // it listens to the first 17 frames
  CHECK(last[5] == 1);
  CHECK(board.pulses(AvrBoard::Led).size() == doctest::Approx(BusySeconds * 1000).epsilon(0.01));
  CHECK((last[6] == 46 || last[6] == 241));
}
