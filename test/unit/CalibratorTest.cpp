// Finding out what a radio sends: what is found, what is refused, at each limit, and what the steps remember.
#include <doctest/doctest.h>

#include <set>
#include <string>
#include <vector>

#include "support/Radio.h"
#include "support/ShowArrays.h"

using sbus::Refusal;
using Numbers = Radio::Numbers;

TEST_CASE(
    "what is refused, on either side of each limit; where no centre is wanted it is in the middle of the travel") {
  const struct {
    const char *what;
    Extent travel, rest;
    Refusal refusal;
  } rows[] = {
      {"did not move", {992, 992}, {992, 992}, Refusal::HardlyMoved},
      {"moved by 399", {800, 1199}, {1000, 1000}, Refusal::HardlyMoved},
      {"moved by 400", {800, 1200}, {1000, 1000}, Refusal::None},
      {"moved by 399, and rests one further", {800, 1199}, {1200, 1200}, Refusal::HardlyMoved},
      {"jitters by 32", {172, 1811}, {976, 1008}, Refusal::None},
      {"jitters by 33", {172, 1811}, {976, 1009}, Refusal::NotStill},
      {"jitters by 33 at its low end", {172, 1811}, {172, 205}, Refusal::NotStill},
      {"rests 32 below", {172, 1811}, {140, 140}, Refusal::None},
      {"rests 33 below", {172, 1811}, {139, 139}, Refusal::CentreOutside},
      {"rests 32 above", {172, 1811}, {1843, 1843}, Refusal::None},
      {"rests 33 above", {172, 1811}, {1844, 1844}, Refusal::CentreOutside},
      {"rests 33 below, at 0", {33, 1811}, {0, 0}, Refusal::CentreOutside},
      {"rests 32 above, at 2047", {172, 2015}, {2047, 2047}, Refusal::None},
      {"rests at low", {200, 1800}, {200, 200}, Refusal::None},
      {"1/16 above low", {200, 1800}, {300, 300}, Refusal::None},
      {"1/16 above low, half a count more", {200, 1800}, {300, 301}, Refusal::NotCentred},
      {"1/4 above low, less one", {200, 1800}, {599, 599}, Refusal::NotCentred},
      {"1/4 above low", {200, 1800}, {600, 600}, Refusal::None},
      {"1/4 below high", {200, 1800}, {1400, 1400}, Refusal::None},
      {"1/4 below high, less one", {200, 1800}, {1401, 1401}, Refusal::NotCentred},
      {"1/16 below high, and one", {200, 1800}, {1699, 1699}, Refusal::NotCentred},
      {"1/16 below high", {200, 1800}, {1700, 1700}, Refusal::None},
      {"415 / 16 is 25", {800, 1215}, {825, 825}, Refusal::None},
      {"... not 26", {800, 1215}, {826, 826}, Refusal::NotCentred},
      {"415 / 4 is 103", {800, 1215}, {903, 903}, Refusal::None},
      {"... not 102", {800, 1215}, {902, 902}, Refusal::NotCentred},
      {"of two reasons the first: hardly moved, jitters", {800, 1199}, {900, 1100}, Refusal::HardlyMoved},
      {"jitters, rests elsewhere", {1000, 1811}, {200, 300}, Refusal::NotStill},
      {"rests elsewhere, and nowhere near", {1000, 1811}, {800, 800}, Refusal::CentreOutside},
  };
  for (const auto &row : rows) {
    CAPTURE(row.what);
    const Radio radio(row.travel, row.rest);
    CHECK(radio.refusal() == row.refusal);
    CHECK((radio.found() == Radio::NotTouched) == (row.refusal != Refusal::None));
    const Finished finished(radio.calibrator, 0x0001);
    CHECK(finished.refusal == row.refusal);
    CHECK(finished.isTouched() == (row.refusal == Refusal::None));
    if (row.refusal == Refusal::NotCentred) {  // a knob, or a switch of six positions
      const auto low = static_cast<uint16_t>(row.travel.low);
      const auto high = static_cast<uint16_t>(row.travel.high);
      const auto middle = static_cast<uint16_t>((low + high + 1) / 2);
      CHECK(Finished(radio.calibrator, 0x0000)[0] == Numbers{low, middle, high, 0});
    }
  }
}

TEST_CASE("what is found: ends, centre and dead zone") {
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
      {"... with a dead zone told", {172, 1811}, {172, 172}, 50, {172, 992, 1811, 0}},
      {"... that its trim holds 1/20 up", {172, 1811}, {254, 254}, -1, {172, 992, 1811, 0}},
      {"... above its travel", {172, 1811}, {1830, 1840}, -1, {172, 1006, 1840, 0}},
      {"middles are rounded up", {172, 1811}, {1000, 1001}, -1, {172, 1001, 1811, 8}},
      {"jitters by 8 either way", {172, 1811}, {992, 1008}, -1, {172, 1000, 1811, 8}},
      {"by 9 downwards", {172, 1811}, {991, 1008}, -1, {172, 1000, 1811, 9}},
      {"by as much as is let pass", {172, 1811}, {984, 1016}, -1, {172, 1000, 1811, 16}},
      {"no dead zone, but jitter", {172, 1811}, {1000, 1002}, 0, {172, 1001, 1811, 1}},
      {"a large dead zone, and jitter", {172, 1811}, {984, 1016}, 40, {172, 1000, 1811, 40}},
      {"the largest", {172, 1811}, {1000, 1000}, 99, {172, 1000, 1811, 99}},
      {"one more", {172, 1811}, {1000, 1000}, 100, {172, 1000, 1811, 99}},
      {"the largest, in the shortest travel, off its middle", {800, 1200}, {900, 900}, 99, {800, 900, 1200, 99}},
      {"values above 2047 are 2047", {0, 65535}, {1024, 1024}, -1, {0, 1024, 2047, 8}},
      {"... resting there, too", {1000, 2048}, {3000, 65535}, -1, {1000, 1524, 2047, 0}},
  };
  for (const auto &row : rows) {
    CAPTURE(row.what);
    const Radio radio(row.travel, row.rest, row.deadZone);
    CHECK(radio.refusal() == Refusal::None);
    CHECK(radio.found() == row.found);
    const Finished finished(radio.calibrator, 0x0001);
    CHECK(finished[0] == row.found);
    CHECK(finished.isGood());
  }
}

TEST_CASE("not seen before it has moved, rested, and been pushed if that was begun; a step forgets those after it") {
  constexpr Numbers Forwards = {172, 1000, 1811, 20};
  constexpr Numbers Backwards = {1811, 1000, 172, 20};
  constexpr Numbers NotSeen = Radio::NotTouched;
  constexpr int Centre = -1, High = -2, Begin = -3;  // calls; what is not below 0 is a value of CH1
  const struct {
    std::vector<int> steps;
    Numbers found;
  } rows[] = {
      {{}, NotSeen},
      {{172, 1811}, NotSeen},
      {{172, 1811, Centre}, NotSeen},
      {{172, 1811, Centre, 1000}, Forwards},
      {{172, 1811, Centre, 1000, High}, NotSeen},
      {{172, 1811, Centre, 1000, High, 172}, Backwards},
      {{Centre, 1000}, NotSeen},
      {{172, 1811, High, 172}, NotSeen},
      {{172, 1811, Centre, 400, 1600, Centre}, NotSeen},
      {{172, 1811, Centre, 400, 1600, Centre, 1000}, Forwards},
      {{172, 1811, Centre, 1000, High, 1811, High}, NotSeen},
      {{172, 1811, Centre, 1000, High, 1811, High, 172}, Backwards},
      {{172, 1811, Centre, 400, High, 172, Centre}, NotSeen},
      {{172, 1811, Centre, 400, High, 172, Centre, 1000}, Forwards},
      {{0, 2047, Begin, 172, 1811, Centre, 1000}, Forwards},
      {{0, 2047, Centre, 0, 2047, Begin, 172, 1811}, NotSeen},
      {{0, 2047, Centre, 0, 2047, Begin, 172, 1811, Centre, 1000}, Forwards},
      {{0, 2047, Centre, 0, 2047, High, 0, 2047, Begin}, NotSeen},
      {{0, 2047, Centre, 0, 2047, High, 0, 2047, Begin, 172, 1811, Centre, 1000}, Forwards},
  };
  for (const auto &row : rows) {
    INFO("row ", &row - rows);
    Radio radio;
    radio.calibrator.setDeadZone(20);
    const auto lostFrames = [&radio] {
      for (const unsigned flags : {1u, 2u, 3u}) {
        Channels lost;
        lost.fill(flags == 1 ? 0 : 2047);
        radio.calibrator.feed(lost.data(), (flags & 1) != 0, (flags & 2) != 0);
      }
    };
    for (const int step : row.steps) {
      lostFrames();
      if (step >= 0) {
        radio.move({step});
      } else if (step == Centre) {
        radio.calibrator.centre();
      } else if (step == High) {
        radio.calibrator.high();
      } else {
        radio.calibrator.begin();
      }
    }
    lostFrames();
    CHECK(radio.found() == row.found);
    CHECK(radio.refusal() == (row.found == NotSeen ? Refusal::NeverSeen : Refusal::None));
  }
}

TEST_CASE("one that falls by more than 1/4 of its travel, and more than it rises, runs backwards; less is no push") {
  const struct {
    const char *what;
    Extent travel;
    int rest;
    std::vector<int> pushed;
    char runs;  // +, -, or not known
  } rows[] = {
      {"to its high end", {200, 1800}, 1000, {1800}, '+'},
      {"stays, as a switch does", {200, 1800}, 1000, {1000}, '?'},
      {"falls by 1/4", {200, 1800}, 1000, {600}, '?'},
      {"falls by 1/4 and one", {200, 1800}, 1000, {599}, '-'},
      {"rises by 1/4", {200, 1800}, 1000, {1400}, '?'},
      {"rises by 1/4 and one", {200, 1800}, 1000, {1401}, '+'},
      {"falls beyond its low end", {200, 1800}, 1000, {0}, '-'},
      {"rises beyond its high end, and beyond 2047", {200, 1800}, 1000, {65535}, '+'},
      {"a throttle that rises", {200, 1800}, 200, {1800}, '+'},
      {"a throttle that stays low", {200, 1800}, 200, {200}, '?'},
      {"a throttle that is low at its high values, and falls", {200, 1800}, 1800, {200}, '-'},
      {"off its middle, falls by 1/4: all there is", {200, 1800}, 600, {200}, '?'},
      {"falls, and is let go", {172, 1811}, 992, {172, 1000, 992}, '-'},
      {"falls further than it rises", {172, 1811}, 992, {600, 172, 1811}, '-'},
      {"falls by 410, and rises by as much, or less", {172, 1811}, 992, {582, 1401}, '-'},
      {"falls and rises by 410", {172, 1811}, 992, {582, 1402}, '+'},
      {"falls by 409, rises by 410", {172, 1811}, 992, {583, 1402}, '+'},
      {"rises, and is let go beyond its rest", {172, 1811}, 992, {1811, 900}, '+'},
      {"all the way up and down", {172, 1811}, 992, {0, 2047}, '+'},
  };
  for (const auto &row : rows) {
    CAPTURE(row.what);
    Radio radio(row.travel, {row.rest, row.rest});
    const Numbers before = radio.found();
    radio.calibrator.high();
    for (const int value : row.pushed) {
      radio.move({value});
    }
    CHECK(radio.refusal() == (row.runs == '?' ? Refusal::NotPushed : Refusal::None));
    CHECK(radio.found() == (row.runs == '?'   ? Radio::NotTouched
                            : row.runs == '-' ? Numbers{before[2], before[1], before[0], before[3]}
                                              : before));
    // Not wanted, it runs forwards.
    const Finished finished(radio.calibrator, 0x0000);
    CHECK(finished.refusal == Refusal::None);
    CHECK(finished[0] == (row.runs == '-' ? radio.found() : before));
    CHECK(Finished(radio.calibrator, 0x0001).refusal == radio.refusal());
  }
}

TEST_CASE("CH1..CH16 are found one by one, whatever their neighbours do; CH17 and CH18 are not read") {
  Radio radio;
  const auto feedSixteen = [&radio](unsigned factor, unsigned offset) {
    std::vector<uint16_t> sixteen;  // the sanitizer guards its end
    for (unsigned i = 0; i < 16; i++) {
      sixteen.push_back(static_cast<uint16_t>(offset + factor * i));
    }
    radio.calibrator.feed(sixteen.data(), false, false);
  };
  feedSixteen(10, 100);
  feedSixteen(10, 1700);
  radio.calibrator.centre();
  feedSixteen(12, 900);
  radio.calibrator.high();
  for (unsigned i = 0; i < 16; i++) {
    radio.channels[i] = i % 3 == 0 ? 100 : 1811;
  }
  radio.feed();
  for (unsigned i = 0; i < 256; i++) {
    CAPTURE(i);
    const auto low = static_cast<uint16_t>(100 + 10 * i);
    const auto high = static_cast<uint16_t>(1700 + 10 * i);
    const auto centre = static_cast<uint16_t>(900 + 12 * i);
    const auto index = static_cast<uint8_t>(i);
    CHECK(radio.refusal(index) == (i < 16 ? Refusal::None : Refusal::NeverSeen));
    CHECK(radio.found(index) == (i >= 16      ? Radio::NotTouched
                                 : i % 3 == 0 ? Numbers{high, centre, low, 8}
                                              : Numbers{low, centre, high, 8}));
  }
}

TEST_CASE("finish names the first bad one of those wanted, or seals all that are good and leaves the others empty") {
  const struct {
    unsigned good, wanted;
    int channel;  // -1: none
  } rows[] = {
      {0xFFFF, 0xFFFF, -1}, {0x0000, 0x0000, -1}, {0x0000, 0xFFFF, 0},  {0x0000, 0x8000, 15}, {0x7FFF, 0xFFFF, 15},
      {0x7FFF, 0x7FFF, -1}, {0x000F, 0x001F, 4},  {0x000F, 0x000F, -1}, {0xFFF0, 0x0008, 3},  {0x0FF0, 0xFFF0, 12},
      {0xFEFF, 0xFFFF, 8},  {0xA5C3, 0x0001, -1}, {0x0001, 0x0001, -1}, {0xFFFE, 0x0001, 0},
  };
  for (const auto &row : rows) {
    INFO("good ", row.good, ", wanted ", row.wanted);
    Radio radio;
    for (const uint16_t value : {uint16_t{172}, uint16_t{1811}, Radio::Rest}) {
      if (value == Radio::Rest) {
        radio.calibrator.centre();
      }
      for (unsigned i = 0; i < 16; i++) {
        radio.channels[i] = (row.good >> i & 1) != 0 ? value : Radio::Rest;
      }
      radio.feed();
    }
    const Finished finished(radio.calibrator, row.wanted);
    CHECK(finished.refusal == (row.channel < 0 ? Refusal::None : Refusal::HardlyMoved));
    CHECK(finished.channel == (row.channel < 0 ? Radio::NoChannel : row.channel));
    CHECK(finished.isTouched() == (row.channel < 0));
    CHECK(finished.isGood() == (row.channel < 0));
    for (unsigned i = 0; i < 16 && row.channel < 0; i++) {
      CHECK(finished[i] == ((row.good >> i & 1) != 0 ? Numbers{172, 992, 1811, 8} : Numbers{0, 0, 0, 0}));
    }
  }
  CHECK(Finished(Radio().calibrator, 0x0400).refusal == Refusal::NeverSeen);
}

TEST_CASE("each refusal has words of its own that stand after a channel's name, and None has none") {
  std::set<std::string> seen;
  for (unsigned number = 1; number <= static_cast<unsigned>(Refusal::NotPushed); number++) {
    const std::string words = text(static_cast<Refusal>(number));
    CAPTURE(words);
    CHECK(words.size() > 8);
    CHECK(words.size() < 64);
    CHECK(words[0] == ' ');
    CHECK(words.find_first_not_of(" abcdefghijklmnopqrstuvwxyz") == std::string::npos);
    CHECK(seen.insert(words).second);
  }
  CHECK(std::string(text(Refusal::None)).empty());
  CHECK(std::string(text(static_cast<Refusal>(200))).empty());
}
