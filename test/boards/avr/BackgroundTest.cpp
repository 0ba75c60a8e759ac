// Runs a sketch that listens in the background on a simulated Mega and Leonardo.
#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "AvrBoard.h"
#include "Expected.h"
#include "line/Source.h"

namespace {

using avr::AvrBoard;

avr::Numbers framesAndChannels(const avr::SeenFrame &frame) {
  avr::Numbers numbers = avr::counters(frame);
  numbers.push_back(0);  // torn
  numbers.insert(numbers.end(), frame.channels.begin(), frame.channels.begin() + 16);
  return numbers;
}

}  // namespace

TEST_CASE(
    "while loop() is busy for 1 to 20 ms, and for 500 ms, in delay() or with calls of all methods, every frame is "
    "received, and no pulse of a servo moves") {
  for (const avr::Model &model : {avr::Mega, avr::Leonardo}) {
    CAPTURE(std::string(model.name));
    avr::Line line;
    line.source = line::Source().open();
    const AvrBoard board(model, "Background", std::move(line), 17.5);
    const avr::Expected expected(board.characters());
    REQUIRE(board.printed().size() > 200);
    const avr::Numbers spins = avr::numbersIn(board.printed().back().text);
    REQUIRE(spins.size() == 2);
    std::string wrong;
    for (size_t i = 0; i + 1 < board.printed().size() && wrong.empty(); i++) {
      wrong = expected.wrong(board.printed()[i].us, avr::numbersIn(board.printed()[i].text), framesAndChannels, 0);
    }
    CHECK(wrong == "");
    CHECK(board.mistakes() == "");
    double shortest = 1500, longest = 1500;
    for (size_t pin = 0; pin < 4; pin++) {
      for (const avr::Pulse &pulse : board.pulses(pin)) {
        shortest = std::min(shortest, pulse.widthUs);
        longest = std::max(longest, pulse.widthUs);
      }
      CHECK(board.pulses(pin).size() > 800);
    }
    CHECK(shortest >= 1499);
    CHECK(longest <= 1501);
    const double share = 100 * (1 - spins[0] / spins[1]);
    MESSAGE(std::string(model.name), ": ", avr::numbersIn(board.printed()[board.printed().size() - 2].text)[0],
            " frames; pulses of ", shortest, " to ", longest, " us");
    avr::figure("`DecodeSBusBackground` (" + std::string(model.name) + "): part of the board's time",
                avr::rounded(share, 0) + " %");
    CHECK(share > 1);
    CHECK(share < 6);
  }
}
