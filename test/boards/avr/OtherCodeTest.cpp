// Frames that a simulated Mega misses beside the code of other libraries: rows of extras/docs/libraries.md.
#include <doctest/doctest.h>

#include <string>
#include <utility>

#include "AvrBoard.h"
#include "Expected.h"
#include "line/Source.h"

namespace {

struct Row {
  const char *what;
  double least, most;  // per cent of the frames
};

// In the order of the sketch's Work.
constexpr Row Rows[] = {
    {"nothing", 0, 0},
    {"interrupts off for 16 LEDs in each loop()", 100, 100},
    {"interrupts off for 150 LEDs after each new frame", 0, 0},
    {"ten characters of a SoftwareSerial each 100 ms", 10, 16},
    {"three characters of a SoftwareSerial after each new frame", 0, 0},
    {"tone() with another pitch each 10 ms", 0, 0},
    {"loop() blocked for 25 ms", 30, 40},
};

}  // namespace

TEST_CASE("what other libraries do costs the frames that libraries.md says, and nothing right after a new frame") {
  uint8_t work = 0;
  for (const Row &row : Rows) {
    CAPTURE(std::string(row.what));
    avr::Line line;
    line.source = line::Source().open();
    const avr::AvrBoard board(avr::Mega, "OtherCode", std::move(line), 6.5, {work++});
    REQUIRE(board.printed().size() > 2);  // millis() stands still while interrupts are off
    const avr::Printed &last = board.printed().back();
    const double sent = avr::Expected(board.characters()).count(0, last.us);
    const double missed = 100 * (1 - avr::numbersIn(last.text).at(0) / sent);
    MESSAGE("missed with ", std::string(row.what), ": ", missed, " %");
    CHECK(missed >= row.least - 0.2);  // the newest may not have been delivered yet
    CHECK(missed <= row.most + 0.2);
  }
}
