// Runs a sketch that listens in the background on a simulated Arduino Mega.
#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "Expected.h"
#include "Mega.h"
#include "line/Source.h"

namespace {

using mega::Mega;

mega::Numbers framesAndChannels(const mega::SeenFrame &frame) {
  mega::Numbers numbers = mega::counters(frame);
  numbers.push_back(0);  // torn
  numbers.insert(numbers.end(), frame.channels.begin(), frame.channels.begin() + 16);
  return numbers;
}

}  // namespace

TEST_CASE(
    "while loop() is busy for 1 to 20 ms, and for 500 ms, in delay() or with calls of all methods, every frame is "
    "received, and no pulse of a servo moves") {
  mega::Line line;
  line.source = line::Source().open();
  const Mega mega("Background", std::move(line), 17.5);
  const mega::Expected expected(mega.characters());
  REQUIRE(mega.printed().size() > 200);
  const mega::Numbers spins = mega::numbersIn(mega.printed().back().text);
  REQUIRE(spins.size() == 2);
  std::string wrong;
  for (size_t i = 0; i + 1 < mega.printed().size() && wrong.empty(); i++) {
    wrong = expected.wrong(mega.printed()[i].us, mega::numbersIn(mega.printed()[i].text), framesAndChannels, 0);
  }
  CHECK(wrong == "");
  CHECK(mega.mistakes() == "");
  double shortest = 1500, longest = 1500;
  for (size_t pin = 0; pin < 4; pin++) {
    for (const mega::Pulse &pulse : mega.pulses(pin)) {
      shortest = std::min(shortest, pulse.widthUs);
      longest = std::max(longest, pulse.widthUs);
    }
    CHECK(mega.pulses(pin).size() > 800);
  }
  CHECK(shortest >= 1499);
  CHECK(longest <= 1501);
  const double share = 100 * (1 - spins[0] / spins[1]);
  MESSAGE(mega::numbersIn(mega.printed()[mega.printed().size() - 2].text)[0], " frames; polls take ", share,
          " % of the time; pulses of ", shortest, " to ", longest, " us");
  CHECK(share > 1);
  CHECK(share < 6);
}
