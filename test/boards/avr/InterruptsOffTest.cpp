// Runs a sketch that turns interrupts off, on a simulated Mega and Leonardo: the USART keeps three characters, and
// micros() stands still.
#include <doctest/doctest.h>

#include <memory>
#include <string>
#include <utility>

#include "AvrBoard.h"
#include "Expected.h"
#include "support/BitByBit.h"

namespace {

using avr::AvrBoard;

// Frames in which all channels are equal, every 9 ms. No two of a second have the same.
class EqualChannels : public line::Line {
 public:
  bool next(uint64_t nowUs, line::Character &character) override {
    const uint64_t frame = _sent / sbus::FrameSize, index = _sent % sbus::FrameSize;
    const uint64_t endUs = 5000 + frame * 9000 + (index + 1) * line::CharacterUs;
    if (endUs > nowUs) {
      return false;
    }
    Channels channels;
    channels.fill(static_cast<uint16_t>(frame * 463 % 2048));
    channels[16] = channels[17] = 0;
    character = line::Character();
    character.endUs = endUs;
    character.value = writeBitByBit(channels)[index];
    _sent++;
    return true;
  }

 private:
  uint64_t _sent = 0;
};

}  // namespace

// Without LineTiming::foundTooFew() there are 95 wrong frames of 789 stops; extras/docs/boards.md says what is left.
TEST_CASE("interrupts off for 9.3 to 9.56 ms, a period and three characters, join two frames in few of the stops") {
  for (const avr::Model &model : {avr::Mega, avr::Leonardo}) {
    CAPTURE(std::string(model.name));
    avr::Line line;
    line.source = std::make_unique<EqualChannels>();
    const AvrBoard board(model, "InterruptsOff", std::move(line), 52);
    const avr::Numbers last = avr::numbersIn(board.printed().back().text);
    MESSAGE(std::string(model.name), ": stops, frames, wrong: ", board.printed().back().text);
    REQUIRE(last.size() == 3);
    CHECK(last[0] > 750);
    CHECK(last[1] > 4500);
    CHECK(last[2] * 30 < last[0]);
    CHECK(board.mistakes().find("characters were not read in time") != std::string::npos);
  }
}
