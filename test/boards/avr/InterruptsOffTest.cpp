// Runs a sketch that turns interrupts off, on a simulated Mega and Leonardo: the USART keeps three characters, and
// micros() stands still.
#include <doctest/doctest.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

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

// Without LineTiming::foundTooFew() and JoinCheck there are 95 wrong frames of 789 stops.
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
    CHECK(last[2] <= 3);
    CHECK(board.mistakes().find("characters were not read in time") != std::string::npos);
  }
}

TEST_CASE("many stops of interrupts, as those of SoftwareSerial and of an LED strip, join no parts of frames") {
  struct Row {
    const char *as;
    uint16_t stopUs, openUs, count, periodMs, isRandom;
    unsigned least;  // frames of some 1200
    unsigned wrong;  // at most: a join before a poll has found too few characters
  };
  const Row rows[] = {
      {"SoftwareSerial at 9600 baud, 5 characters in each loop()", 1042, 6, 5, 0, 0, 0, 0},
      {"10 characters in each loop()", 1042, 6, 10, 0, 0, 0, 0},
      {"20 characters in each loop()", 1042, 6, 20, 0, 0, 0, 0},
      {"10 characters each 20 ms", 1042, 6, 10, 20, 0, 350, 1},
      {"50 characters each 100 ms", 1042, 6, 50, 100, 0, 500, 0},
      {"an LED strip, 16 LEDs in each loop()", 480, 300, 1, 0, 0, 0, 0},
      {"60 LEDs", 1800, 300, 1, 0, 0, 0, 0},
      {"90 LEDs", 2700, 60, 1, 0, 0, 0, 0},
      {"180 LEDs", 5400, 300, 1, 0, 0, 0, 0},
      {"in step with the line", 900, 100, 9, 0, 0, 0, 0},
      {"five stops of 5 ms at most, each 30 ms", 5000, 2000, 5, 30, 1, 400, 1},
  };
  for (const char *sketch : {"ManyStops", "ManyStopsBackground"}) {
    CAPTURE(std::string(sketch));
    for (const Row &row : rows) {
      CAPTURE(std::string(row.as));
      avr::Line line;
      line.source = std::make_unique<EqualChannels>();
      std::vector<uint8_t> eeprom;
      for (const uint16_t number : {row.stopUs, row.openUs, row.count, row.periodMs, row.isRandom}) {
        eeprom.push_back(static_cast<uint8_t>(number));
        eeprom.push_back(static_cast<uint8_t>(number >> 8));
      }
      const AvrBoard board(avr::Mega, sketch, std::move(line), 12, eeprom);
      REQUIRE(!board.printed().empty());
      MESSAGE(std::string(sketch), ", ", std::string(row.as), ": frames, wrong: ", board.printed().back().text);
      const avr::Numbers last = avr::numbersIn(board.printed().back().text);
      REQUIRE(last.size() == 2);
      CHECK(last[0] >= row.least);
      CHECK(last[1] <= row.wrong);
    }
  }
}
