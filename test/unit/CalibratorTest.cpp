// Finds out what a radio sends: ends, centre and dead zone of a channel, and what is rejected at each limit.
#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "support/Radio.h"
#include "support/ShowArrays.h"

using sbus::CalibrationError;
using Numbers = Radio::Numbers;

TEST_CASE("a channel is rejected, on either side of each limit; a centre that is not required is in the travel's middle") {
  const struct {
    const char *what;
    Extent travel, rest;
    CalibrationError error;
  } rows[] = {
      {"did not move", {992, 992}, {992, 992}, CalibrationError::HardlyMoved},
      {"moved by 399", {800, 1199}, {1000, 1000}, CalibrationError::HardlyMoved},
      {"moved by 400", {800, 1200}, {1000, 1000}, CalibrationError::None},
      {"moved by 399, and rests one further", {800, 1199}, {1200, 1200}, CalibrationError::HardlyMoved},
      {"jitters by 32", {172, 1811}, {976, 1008}, CalibrationError::None},
      {"jitters by 33", {172, 1811}, {976, 1009}, CalibrationError::NotStill},
      {"jitters by 33 at its low end", {172, 1811}, {172, 205}, CalibrationError::NotStill},
      {"rests 1/16 below", {172, 1811}, {70, 70}, CalibrationError::None},
      {"... and one", {172, 1811}, {69, 69}, CalibrationError::CentreOutside},
      {"rests 1/16 above", {172, 1811}, {1913, 1913}, CalibrationError::None},
      {"... and one", {172, 1811}, {1914, 1914}, CalibrationError::CentreOutside},
      {"rests 1/16 and one below, at 0", {107, 1811}, {0, 0}, CalibrationError::CentreOutside},
      {"rests above, at 2047", {172, 1945}, {2047, 2047}, CalibrationError::None},
      {"rests at its low end in the middle of the scale", {992, 1811}, {992, 992}, CalibrationError::MovedOneWay},
      {"... at its high end", {172, 1000}, {1000, 1000}, CalibrationError::MovedOneWay},
      {"... 1/16 above it", {992, 1811}, {1043, 1043}, CalibrationError::MovedOneWay},
      {"699 is not in the middle", {699, 1811}, {699, 699}, CalibrationError::None},
      {"700 is", {700, 1811}, {700, 700}, CalibrationError::MovedOneWay},
      {"1350 is", {172, 1350}, {1350, 1350}, CalibrationError::MovedOneWay},
      {"1351 is not", {172, 1351}, {1351, 1351}, CalibrationError::None},
      {"rests at low", {200, 1800}, {200, 200}, CalibrationError::None},
      {"1/16 above low", {200, 1800}, {300, 300}, CalibrationError::None},
      {"1/16 above low, half a count more", {200, 1800}, {300, 301}, CalibrationError::NotCentred},
      {"1/4 above low, less one", {200, 1800}, {599, 599}, CalibrationError::NotCentred},
      {"1/4 above low", {200, 1800}, {600, 600}, CalibrationError::None},
      {"1/4 below high", {200, 1800}, {1400, 1400}, CalibrationError::None},
      {"1/4 below high, less one", {200, 1800}, {1401, 1401}, CalibrationError::NotCentred},
      {"1/16 below high, and one", {200, 1800}, {1699, 1699}, CalibrationError::NotCentred},
      {"1/16 below high", {200, 1800}, {1700, 1700}, CalibrationError::None},
      {"415 / 16 is 25", {200, 615}, {225, 225}, CalibrationError::None},
      {"... not 26", {200, 615}, {226, 226}, CalibrationError::NotCentred},
      {"415 / 4 is 103", {200, 615}, {303, 303}, CalibrationError::None},
      {"... not 102", {200, 615}, {302, 302}, CalibrationError::NotCentred},
      {"of two reasons the first: hardly moved, jitters", {800, 1199}, {900, 1100}, CalibrationError::HardlyMoved},
      {"jitters, rests elsewhere", {1000, 1811}, {200, 300}, CalibrationError::NotStill},
      {"rests elsewhere, and nowhere near", {1000, 1811}, {800, 800}, CalibrationError::CentreOutside},
  };
  for (const auto &row : rows) {
    CAPTURE(row.what);
    const Radio radio(row.travel, row.rest);
    CHECK(radio.error() == row.error);
    CHECK((radio.found() == Radio::NotTouched) == (row.error != CalibrationError::None));
    const Finished finished(radio.calibrator, 0x0001);
    CHECK(finished.error == row.error);
    CHECK(finished.isTouched() == (row.error == CalibrationError::None));
    if (row.error == CalibrationError::NotCentred) {  // a knob, or a switch of six positions
      const auto low = static_cast<uint16_t>(row.travel.low);
      const auto high = static_cast<uint16_t>(row.travel.high);
      const auto middle = static_cast<uint16_t>((low + high + 1) / 2);
      CHECK(Finished(radio.calibrator, 0x0000)[0] ==
            (radio.backwards ? Numbers{high, middle, low, 0} : Numbers{low, middle, high, 0}));
    }
  }
}

TEST_CASE("ends, centre and dead zone are found") {
  const struct {
    const char *what;
    Extent travel, rest;
    int deadZone;  // -1: not set
    Numbers found;
  } rows[] = {
      {"a FrSky's stick", {172, 1811}, {992, 992}, -1, {172, 992, 1811, 8}},
      {"the other end first, trimmed", {1811, 172}, {1050, 1050}, -1, {172, 1050, 1811, 8}},
      {"a throttle that jitters", {172, 1811}, {172, 180}, -1, {172, 992, 1811, 0}},
      {"... below its travel", {172, 1811}, {150, 160}, -1, {150, 981, 1811, 0}},
      {"... with a dead zone set", {172, 1811}, {172, 172}, 50, {172, 992, 1811, 0}},
      {"... that its trim holds 1/20 up", {172, 1811}, {254, 254}, -1, {172, 992, 1811, 0}},
      {"... above its travel", {172, 1811}, {1830, 1840}, -1, {1840, 1006, 172, 0}},
      {"middles are rounded up", {172, 1811}, {1000, 1001}, -1, {172, 1001, 1811, 8}},
      {"jitters by 8 either way", {172, 1811}, {992, 1008}, -1, {172, 1000, 1811, 8}},
      {"by 9 downwards", {172, 1811}, {991, 1008}, -1, {172, 1000, 1811, 9}},
      {"by the most that is accepted", {172, 1811}, {984, 1016}, -1, {172, 1000, 1811, 16}},
      {"no dead zone, but jitter", {172, 1811}, {1000, 1002}, 0, {172, 1001, 1811, 1}},
      {"a large dead zone, and jitter", {172, 1811}, {984, 1016}, 40, {172, 1000, 1811, 40}},
      {"the largest", {172, 1811}, {1000, 1000}, 99, {172, 1000, 1811, 99}},
      {"one more", {172, 1811}, {1000, 1000}, 100, {172, 1000, 1811, 99}},
      {"the largest, in the shortest travel, off its middle", {800, 1200}, {900, 900}, 99, {800, 900, 1200, 99}},
      {"values above 2047 are 2047", {0, 65535}, {1024, 1024}, -1, {0, 1024, 2047, 8}},
      {"... also when it rests there", {1000, 2048}, {3000, 65535}, -1, {2047, 1524, 1000, 0}},
  };
  for (const auto &row : rows) {
    CAPTURE(row.what);
    const Radio radio(row.travel, row.rest, row.deadZone);
    CHECK(radio.error() == CalibrationError::None);
    CHECK(radio.found() == row.found);
    const Finished finished(radio.calibrator, 0x0001);
    CHECK(finished[0] == row.found);
    CHECK(finished.isGood());
  }
}

TEST_CASE("an end counts once three frames in a row have reached it; reached() returns the ends that count") {
  for (const int wrong : {0, 2047}) {
    for (int frames = 1; frames <= 4; frames++) {
      CAPTURE(wrong);
      CAPTURE(frames);
      Radio radio;
      uint16_t low = 11, high = 22;
      CHECK_FALSE(radio.calibrator.reached(0, low, high));
      radio.move({172});
      for (int often = 0; often < 10; often++) {
        radio.stay(wrong, frames);
        radio.move({1811, 172});
      }
      CHECK(radio.calibrator.reached(0, low, high));
      CHECK(low == (frames >= 3 && wrong == 0 ? 0 : 172));
      CHECK(high == (frames >= 3 && wrong != 0 ? 2047 : 1811));
      CHECK_FALSE(radio.calibrator.reached(16, low, high));
    }
  }
}

TEST_CASE("CH1..CH16 are measured independently of each other; CH17 and CH18 are not read") {
  Radio radio;
  const auto feedSixteen = [&radio](unsigned factor, unsigned offset) {
    std::vector<uint16_t> sixteen;  // the sanitizer guards its end
    for (unsigned i = 0; i < 16; i++) {
      sixteen.push_back(static_cast<uint16_t>(offset + factor * i));
    }
    for (int frames = 0; frames < sbus::Calibrator::SeenFrames; frames++) {
      radio.calibrator.feed(sixteen.data(), false, false);
    }
  };
  feedSixteen(10, 100);
  feedSixteen(10, 1700);
  radio.calibrator.centre();
  feedSixteen(12, 900);
  radio.calibrator.high();
  for (unsigned i = 0; i < 16; i++) {
    radio.channels[i] = static_cast<uint16_t>((i % 3 == 0 ? 100 : 1700) + 10 * i);
  }
  radio.feed(sbus::Calibrator::HeldFrames);
  for (unsigned i = 0; i < 256; i++) {
    CAPTURE(i);
    const auto low = static_cast<uint16_t>(100 + 10 * i);
    const auto high = static_cast<uint16_t>(1700 + 10 * i);
    const auto centre = static_cast<uint16_t>(900 + 12 * i);
    const auto index = static_cast<uint8_t>(i);
    CHECK(radio.error(index) == (i < 16 ? CalibrationError::None : CalibrationError::NeverSeen));
    CHECK(radio.found(index) == (i >= 16      ? Radio::NotTouched
                                 : i % 3 == 0 ? Numbers{high, centre, low, 8}
                                              : Numbers{low, centre, high, 8}));
  }
}

TEST_CASE("each error has its own text, which follows a channel's name and says what to do; None has no text") {
  std::vector<std::string> seen;
  for (unsigned number = 1; number <= static_cast<unsigned>(CalibrationError::NotHeld); number++) {
    const std::string words = text(static_cast<CalibrationError>(number));
    CAPTURE(words);
    CHECK(words.size() > 8);
    CHECK(words.size() < 80);
    CHECK(words[0] == ' ');
    CHECK(words.find(": ") != std::string::npos);  // what to do
    CHECK(words.find_first_not_of(" abcdefghijklmnopqrstuvwxyz:") == std::string::npos);
    CHECK(std::count(seen.begin(), seen.end(), words) == 0);
    seen.push_back(words);
  }
  CHECK(std::string(text(CalibrationError::None)).empty());
  CHECK(std::string(text(static_cast<CalibrationError>(200))).empty());
}
