// Finding out what a radio sends: what is found, what is refused, at each limit, and what the steps remember.
#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <string>
#include <vector>

#include "support/ShowArrays.h"
#include "sbus/Calibrator.h"

namespace {

using sbus::CalibratedChannel;
using sbus::Calibration;
using sbus::Calibrator;
using sbus::Refusal;
using sbus::StoredState;

constexpr uint16_t Rest = 992;

// Low, centre, high and dead zone.
using Numbers = std::array<uint16_t, 4>;
constexpr Numbers Untouched = {11, 22, 33, 44};
constexpr Numbers Empty = {0, 0, 0, 0};

Numbers numbersOf(const CalibratedChannel &channel) {
  return {channel.range.low, channel.range.centre, channel.range.high, channel.deadZone};
}

// As a sketch feeds it: 18 values, of which all rest but those that are moved.
struct Radio {
  Calibrator calibrator;
  std::array<uint16_t, 18> channels;

  Radio() { channels.fill(Rest); }

  void feed(bool failsafe = false, bool lostFrame = false) { calibrator.feed(channels.data(), failsafe, lostFrame); }

  void feedAll(uint16_t value, bool failsafe = false, bool lostFrame = false) {
    channels.fill(value);
    feed(failsafe, lostFrame);
  }

  void move(size_t channel, std::initializer_list<int> values) {
    for (const int value : values) {
      channels[channel] = static_cast<uint16_t>(value);
      feed();
    }
  }

  Refusal refusal(uint8_t channel = 0) const {
    CalibratedChannel found;
    return calibrator.result(channel, found);
  }

  Numbers found(uint8_t channel = 0) const {
    CalibratedChannel found = {{Untouched[0], Untouched[1], Untouched[2]}, Untouched[3]};
    calibrator.result(channel, found);
    return numbersOf(found);
  }
};

struct Extent {
  int low, high;
};

// CH1 goes through its travel, then rests.
Radio moved(Extent travel, Extent rest, int deadZone = -1) {
  Radio radio;
  if (deadZone >= 0) {
    radio.calibrator.setDeadZone(static_cast<uint16_t>(deadZone));
  }
  radio.move(0, {travel.low, travel.high});
  radio.calibrator.centre();
  radio.move(0, {rest.low, rest.high});
  return radio;
}

// All sixteen, each as `good` has a bit for it: the others stand still.
Radio movedThese(uint16_t good) {
  Radio radio;
  for (const uint16_t value : {uint16_t{172}, uint16_t{1811}, Rest}) {
    for (unsigned i = 0; i < 16; i++) {
      radio.channels[i] = (good >> i & 1) != 0 ? value : Rest;
    }
    radio.feed();
  }
  radio.calibrator.centre();
  radio.feedAll(Rest);
  return radio;
}

std::array<uint8_t, sizeof(Calibration)> bytesOf(const Calibration &calibration) {
  std::array<uint8_t, sizeof(Calibration)> bytes;
  std::memcpy(bytes.data(), &calibration, bytes.size());
  return bytes;
}

Calibration filled(int value) {
  Calibration calibration;
  std::memset(&calibration, value, sizeof calibration);
  return calibration;
}

constexpr uint8_t NoChannel = 99;

}  // namespace

TEST_CASE("what is refused, and what is not, on either side of each limit") {
  const struct {
    const char *what;
    Extent travel, rest;
    Refusal refusal;
  } rows[] = {
      {"a FrSky's stick", {172, 1811}, {992, 992}, Refusal::None},
      {"a Futaba's, +-140 %", {78, 1964}, {1024, 1024}, Refusal::None},
      {"all that there is", {0, 2047}, {1024, 1024}, Refusal::None},
      {"did not move", {992, 992}, {992, 992}, Refusal::HardlyMoved},
      {"moved by 399", {800, 1199}, {1000, 1000}, Refusal::HardlyMoved},
      {"moved by 400", {800, 1200}, {1000, 1000}, Refusal::None},
      {"moved by 399 at the bottom", {0, 399}, {200, 200}, Refusal::HardlyMoved},
      {"moved by 400 at the bottom", {0, 400}, {200, 200}, Refusal::None},
      {"moved by 399 at the top", {1648, 2047}, {1848, 1848}, Refusal::HardlyMoved},
      {"moved by 400 at the top", {1647, 2047}, {1847, 1847}, Refusal::None},
      {"moved by 399, and rests one further", {800, 1199}, {1200, 1200}, Refusal::HardlyMoved},
      {"jitters by 32", {172, 1811}, {976, 1008}, Refusal::None},
      {"jitters by 33", {172, 1811}, {976, 1009}, Refusal::NotStill},
      {"jitters by 33, downwards", {172, 1811}, {1009, 976}, Refusal::NotStill},
      {"jitters by 33 at its low end", {172, 1811}, {172, 205}, Refusal::NotStill},
      {"went on moving", {172, 1811}, {172, 1811}, Refusal::NotStill},
      {"rests 32 below", {172, 1811}, {140, 140}, Refusal::None},
      {"rests 33 below", {172, 1811}, {139, 139}, Refusal::CentreOutside},
      {"rests from 33 to 1 below", {172, 1811}, {139, 171}, Refusal::CentreOutside},
      {"rests 32 above", {172, 1811}, {1843, 1843}, Refusal::None},
      {"rests 33 above", {172, 1811}, {1844, 1844}, Refusal::CentreOutside},
      {"rests from 1 to 33 above", {172, 1811}, {1812, 1844}, Refusal::CentreOutside},
      {"was moved to one end only", {992, 1811}, {400, 400}, Refusal::CentreOutside},
      {"rests 32 below, at 0", {32, 1811}, {0, 0}, Refusal::None},
      {"rests 33 below, at 0", {33, 1811}, {0, 0}, Refusal::CentreOutside},
      {"rests 32 above, at 2047", {172, 2015}, {2047, 2047}, Refusal::None},
      {"rests 33 above, at 2047", {172, 2014}, {2047, 2047}, Refusal::CentreOutside},
      {"rests at low", {200, 1800}, {200, 200}, Refusal::None},
      {"1/16 above low", {200, 1800}, {300, 300}, Refusal::None},
      {"1/16 above low, half a count more", {200, 1800}, {300, 301}, Refusal::NotCentred},
      {"1/16 above low, and one", {200, 1800}, {301, 301}, Refusal::NotCentred},
      {"1/10 above low", {200, 1800}, {360, 360}, Refusal::NotCentred},
      {"1/4 above low, less one", {200, 1800}, {599, 599}, Refusal::NotCentred},
      {"1/4 above low", {200, 1800}, {600, 600}, Refusal::None},
      {"1/4 below high", {200, 1800}, {1400, 1400}, Refusal::None},
      {"1/4 below high, less one", {200, 1800}, {1401, 1401}, Refusal::NotCentred},
      {"1/16 below high, and one", {200, 1800}, {1699, 1699}, Refusal::NotCentred},
      {"1/16 below high", {200, 1800}, {1700, 1700}, Refusal::None},
      {"rests at high", {200, 1800}, {1800, 1800}, Refusal::None},
      {"415 / 16 is 25", {800, 1215}, {825, 825}, Refusal::None},
      {"... not 26", {800, 1215}, {826, 826}, Refusal::NotCentred},
      {"415 / 4 is 103", {800, 1215}, {903, 903}, Refusal::None},
      {"... not 102", {800, 1215}, {902, 902}, Refusal::NotCentred},
      {"of two reasons the first: hardly moved, jitters", {800, 1199}, {900, 1100}, Refusal::HardlyMoved},
      {"hardly moved, rests elsewhere", {800, 1199}, {200, 200}, Refusal::HardlyMoved},
      {"jitters, rests elsewhere", {1000, 1811}, {200, 300}, Refusal::NotStill},
      {"rests elsewhere, and nowhere near", {1000, 1811}, {800, 800}, Refusal::CentreOutside},
  };
  for (const auto &row : rows) {
    CAPTURE(row.what);
    const Radio radio = moved(row.travel, row.rest);
    CHECK(radio.refusal() == row.refusal);
    CHECK((radio.found() == Untouched) == (row.refusal != Refusal::None));
    CalibratedChannel found = {{0, 0, 0}, 0};
    radio.calibrator.result(0, found);
    CHECK(sbus::isPossible(found));
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
      {"the other end first", {1811, 172}, {992, 992}, -1, {172, 992, 1811, 8}},
      {"trimmed", {172, 1811}, {1050, 1050}, -1, {172, 1050, 1811, 8}},
      {"a throttle", {172, 1811}, {172, 172}, -1, {172, 992, 1811, 0}},
      {"... that jitters", {172, 1811}, {172, 180}, -1, {172, 992, 1811, 0}},
      {"... below its travel", {172, 1811}, {150, 160}, -1, {150, 981, 1811, 0}},
      {"... with a dead zone told", {172, 1811}, {172, 172}, 50, {172, 992, 1811, 0}},
      {"... that its trim holds 1/20 up", {172, 1811}, {254, 254}, -1, {172, 992, 1811, 0}},
      {"... that a spring centres", {172, 1811}, {992, 992}, -1, {172, 992, 1811, 8}},
      {"at high", {172, 1811}, {1811, 1811}, -1, {172, 992, 1811, 0}},
      {"... above its travel", {172, 1811}, {1830, 1840}, -1, {172, 1006, 1840, 0}},
      {"middles are rounded up", {172, 1811}, {1000, 1001}, -1, {172, 1001, 1811, 8}},
      {"jitters by 8 either way", {172, 1811}, {992, 1008}, -1, {172, 1000, 1811, 8}},
      {"by 9 downwards", {172, 1811}, {991, 1008}, -1, {172, 1000, 1811, 9}},
      {"by 17", {172, 1811}, {992, 1009}, -1, {172, 1001, 1811, 9}},
      {"by as much as is let pass", {172, 1811}, {984, 1016}, -1, {172, 1000, 1811, 16}},
      {"no dead zone", {172, 1811}, {1000, 1000}, 0, {172, 1000, 1811, 0}},
      {"no dead zone, but jitter", {172, 1811}, {1000, 1002}, 0, {172, 1001, 1811, 1}},
      {"a large dead zone, and jitter", {172, 1811}, {984, 1016}, 40, {172, 1000, 1811, 40}},
      {"the largest", {172, 1811}, {1000, 1000}, 99, {172, 1000, 1811, 99}},
      {"one more", {172, 1811}, {1000, 1000}, 100, {172, 1000, 1811, 99}},
      {"65535", {172, 1811}, {1000, 1000}, 65535, {172, 1000, 1811, 99}},
      {"the largest, in the shortest travel, off its middle", {800, 1200}, {900, 900}, 99, {800, 900, 1200, 99}},
      {"... on the other side", {800, 1200}, {1100, 1100}, 99, {800, 1100, 1200, 99}},
      {"values above 2047 are 2047", {0, 65535}, {1024, 1024}, -1, {0, 1024, 2047, 8}},
      {"... resting there, too", {1000, 2048}, {3000, 65535}, -1, {1000, 1524, 2047, 0}},
  };
  for (const auto &row : rows) {
    CAPTURE(row.what);
    const Radio radio = moved(row.travel, row.rest, row.deadZone);
    CHECK(radio.refusal() == Refusal::None);
    CHECK(radio.found() == row.found);
    CalibratedChannel found;
    radio.calibrator.result(0, found);
    CHECK(sbus::isPossible(found));
    CHECK(sbus::isCalibrated(found));
  }
}

TEST_CASE("what was never seen to move, to rest, or to be pushed is refused as not seen") {
  Radio radio;
  CHECK(radio.refusal() == Refusal::NeverSeen);
  radio.move(0, {172, 1811});
  CHECK(radio.refusal() == Refusal::NeverSeen);
  radio.calibrator.centre();
  CHECK(radio.refusal() == Refusal::NeverSeen);
  radio.move(0, {992});
  CHECK(radio.refusal() == Refusal::None);
  radio.calibrator.high();
  CHECK(radio.refusal() == Refusal::NeverSeen);
  radio.move(0, {1811});
  CHECK(radio.refusal() == Refusal::None);

  Radio neverMoved;
  neverMoved.calibrator.centre();
  neverMoved.move(0, {992});
  CHECK(neverMoved.refusal() == Refusal::NeverSeen);

  Radio neverRested;
  neverRested.move(0, {172, 1811});
  neverRested.calibrator.high();
  neverRested.move(0, {1811});
  CHECK(neverRested.refusal() == Refusal::NeverSeen);
  CHECK(neverRested.found() == Untouched);
}

TEST_CASE("a frame with failsafe, lost frame or both says nothing, in any step") {
  for (unsigned flags = 1; flags < 4; flags++) {
    CAPTURE(flags);
    const bool failsafe = (flags & 1) != 0;
    const bool lostFrame = (flags & 2) != 0;
    const auto damage = [&](Radio &radio) {
      const auto kept = radio.channels;
      for (const uint16_t value : {uint16_t{0}, uint16_t{2047}, uint16_t{1400}}) {
        radio.feedAll(value, failsafe, lostFrame);
      }
      radio.channels = kept;
    };
    Radio radio;
    damage(radio);
    CHECK(radio.refusal() == Refusal::NeverSeen);
    radio.move(0, {1811, 172});
    damage(radio);
    radio.calibrator.centre();
    damage(radio);
    CHECK(radio.refusal() == Refusal::NeverSeen);
    radio.move(0, {1000});
    damage(radio);
    CHECK(radio.found() == Numbers{172, 1000, 1811, 8});
    radio.calibrator.high();
    damage(radio);
    CHECK(radio.refusal() == Refusal::NeverSeen);
    radio.move(0, {172});
    damage(radio);
    CHECK(radio.found() == Numbers{1811, 1000, 172, 8});
  }
}

TEST_CASE("a channel that falls by more than 1/4 of its travel when it is pushed runs backwards; less is no push") {
  const struct {
    const char *what;
    Extent travel;
    int rest, pushed;
    char runs;  // +, -, or not known
  } rows[] = {
      {"to its high end", {200, 1800}, 1000, 1800, '+'},
      {"stays, as a switch does", {200, 1800}, 1000, 1000, '?'},
      {"falls by 1/4", {200, 1800}, 1000, 600, '?'},
      {"falls by 1/4 and one", {200, 1800}, 1000, 599, '-'},
      {"falls to its low end", {200, 1800}, 1000, 200, '-'},
      {"falls beyond its low end", {200, 1800}, 1000, 0, '-'},
      {"rises beyond its high end, and beyond 2047", {200, 1800}, 1000, 65535, '+'},
      {"a throttle that rises", {200, 1800}, 200, 1800, '+'},
      {"a throttle that stays low", {200, 1800}, 200, 200, '?'},
      {"a throttle that is low at its high values, and falls", {200, 1800}, 1800, 200, '-'},
      {"a throttle that is low there, and falls by 1/4", {200, 1800}, 1800, 1400, '?'},
      {"a throttle that is low there, and falls by 1/4 and one", {200, 1800}, 1800, 1399, '-'},
      {"a switch that rests at high", {200, 1800}, 1800, 1800, '?'},
      {"off its middle, falls by less than 1/4", {200, 1800}, 600, 201, '?'},
      {"off its middle, falls by 1/4: all there is", {200, 1800}, 600, 200, '?'},
  };
  for (const auto &row : rows) {
    CAPTURE(row.what);
    Radio radio = moved(row.travel, {row.rest, row.rest});
    const Numbers before = radio.found();
    radio.calibrator.high();
    radio.move(0, {row.pushed});
    CHECK(radio.refusal() == (row.runs == '?' ? Refusal::NotPushed : Refusal::None));
    CHECK(radio.found() == (row.runs == '?'   ? Untouched
                            : row.runs == '-' ? Numbers{before[2], before[1], before[0], before[3]}
                                              : before));
    Calibration calibration = filled(0);
    uint8_t channel = NoChannel;
    CHECK(radio.calibrator.finish(0x0000, calibration, channel) == Refusal::None);
    CHECK((calibration.channels[0].range.low > calibration.channels[0].range.high) == (row.runs == '-'));
  }
}

TEST_CASE("in the third step counts how far it fell and rose, wherever it is let go; and that widens and shifts nothing") {
  const struct {
    std::initializer_list<int> pushed;
    bool backwards;
  } rows[] = {
      {{172}, true},          {{172, 992}, true},         {{172, 1000, 992}, true}, {{600, 172, 1811}, true},
      {{1811}, false},        {{1811, 992}, false},       {{1811, 900}, false},     {{0, 2047}, false},
      {{492, 1491, 992}, true}, {{492, 1492, 992}, false}, {{583, 1402}, false},    {{1402, 582, 992}, false},
      {{582, 1401}, true},    {{582, 1402}, false},       {{0, 172}, true},         {{2047, 1811}, false},
  };
  for (const auto &row : rows) {
    CAPTURE(row.pushed.size());
    CAPTURE(*row.pushed.begin());
    Radio radio = moved({172, 1811}, {992, 992});
    radio.calibrator.high();
    radio.move(0, row.pushed);
    CHECK(radio.found() == (row.backwards ? Numbers{1811, 992, 172, 8} : Numbers{172, 992, 1811, 8}));
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
  for (uint8_t i = 0; i < 16; i++) {
    CAPTURE(i);
    const auto low = static_cast<uint16_t>(100 + 10 * i);
    const auto high = static_cast<uint16_t>(1700 + 10 * i);
    const auto centre = static_cast<uint16_t>(900 + 12 * i);
    CHECK(radio.found(i) == (i % 3 == 0 ? Numbers{high, centre, low, 8} : Numbers{low, centre, high, 8}));
  }
}

TEST_CASE("there is no channel behind CH16") {
  const Radio radio = moved({172, 1811}, {992, 992});
  for (unsigned channel = 16; channel < 256; channel++) {
    CAPTURE(channel);
    CHECK(radio.refusal(static_cast<uint8_t>(channel)) == Refusal::NeverSeen);
    CHECK(radio.found(static_cast<uint8_t>(channel)) == Untouched);
  }
}

TEST_CASE("begin forgets all but the dead zone, in whatever step") {
  for (unsigned steps = 0; steps < 4; steps++) {
    CAPTURE(steps);
    Radio radio;
    radio.calibrator.setDeadZone(20);
    radio.move(0, {0, 2047});
    if (steps > 0) {
      radio.calibrator.centre();
      radio.move(0, {500});
    }
    if (steps > 1) {
      radio.calibrator.high();
    }
    if (steps > 2) {
      radio.move(0, {0});
    }
    radio.calibrator.begin();
    CHECK(radio.refusal() == Refusal::NeverSeen);
    radio.move(0, {172, 1811});
    CHECK(radio.refusal() == Refusal::NeverSeen);
    radio.calibrator.centre();
    radio.move(0, {992});
    CHECK(radio.found() == Numbers{172, 992, 1811, 20});
  }
}

TEST_CASE("centre begins the second step anew: the travel stays, the push is forgotten") {
  Radio radio = moved({172, 1811}, {400, 1600});
  CHECK(radio.refusal() == Refusal::NotStill);
  radio.calibrator.centre();
  CHECK(radio.refusal() == Refusal::NeverSeen);
  radio.move(0, {992});
  CHECK(radio.found() == Numbers{172, 992, 1811, 8});
  radio.calibrator.high();
  radio.move(0, {172});
  CHECK(radio.found() == Numbers{1811, 992, 172, 8});
  radio.calibrator.centre();
  radio.move(0, {1000});
  CHECK(radio.found() == Numbers{172, 1000, 1811, 8});
}

TEST_CASE("high begins the third step anew: travel and rest stay") {
  Radio radio = moved({172, 1811}, {992, 992});
  radio.calibrator.high();
  radio.move(0, {172});
  radio.calibrator.high();
  CHECK(radio.refusal() == Refusal::NeverSeen);
  radio.move(0, {1811});
  CHECK(radio.found() == Numbers{172, 992, 1811, 8});
}

TEST_CASE("asking changes nothing, and the dead zone may be told at any time") {
  Radio radio = moved({172, 1811}, {992, 992});
  const Numbers once = radio.found();
  CHECK(radio.found() == once);
  radio.calibrator.setDeadZone(30);
  CHECK(radio.found() == Numbers{172, 992, 1811, 30});
}

TEST_CASE("finish seals all that are good, and leaves those empty that are neither good nor wanted") {
  for (const unsigned good : {0x0000u, 0x0001u, 0x000Fu, 0x8000u, 0xA5C3u, 0xFFFFu}) {
    CAPTURE(good);
    const Radio radio = movedThese(static_cast<uint16_t>(good));
    Calibration calibration = filled(0xA5);
    uint8_t channel = NoChannel;
    REQUIRE(radio.calibrator.finish(static_cast<uint16_t>(good), calibration, channel) == Refusal::None);
    CHECK(channel == NoChannel);
    CHECK(calibration.version == 1);
    CHECK(sbus::stateOf(calibration) == StoredState::Good);
    for (unsigned i = 0; i < 16; i++) {
      CAPTURE(i);
      CHECK(numbersOf(calibration.channels[i]) == ((good >> i & 1) != 0 ? Numbers{172, 992, 1811, 8} : Empty));
    }
  }
}

TEST_CASE("a knob or a switch that rests anywhere has its centre in the middle of its travel, unless it is wanted") {
  for (const int rest : {172 + 103, 400, 172 + 408, 1811 - 408, 1600, 1811 - 103}) {
    CAPTURE(rest);
    const Radio radio = moved({172, 1811}, {rest, rest});
    REQUIRE(radio.refusal() == Refusal::NotCentred);
    Calibration calibration = filled(0xA5);
    uint8_t channel = NoChannel;
    CHECK(radio.calibrator.finish(0x0001, calibration, channel) == Refusal::NotCentred);
    CHECK(channel == 0);
    CHECK(radio.calibrator.finish(0x0000, calibration, channel) == Refusal::None);
    CHECK(numbersOf(calibration.channels[0]) == Numbers{172, 992, 1811, 0});
    CHECK(sbus::stateOf(calibration) == StoredState::Good);
  }
}

TEST_CASE("finish names the first bad one of those wanted, says why, and leaves the calibration as it is") {
  const struct {
    unsigned good, wanted;
    int channel;  // -1: none
  } rows[] = {
      {0xFFFF, 0xFFFF, -1}, {0x0000, 0x0000, -1}, {0x0000, 0xFFFF, 0},  {0x0000, 0x8000, 15}, {0x7FFF, 0xFFFF, 15},
      {0x7FFF, 0x7FFF, -1}, {0x000F, 0x001F, 4},  {0x000F, 0x000F, -1}, {0xFFF0, 0x0008, 3},  {0x0FF0, 0xFFF0, 12},
      {0xFEFF, 0xFFFF, 8},  {0xFDFF, 0xFFFF, 9},  {0x0001, 0x0001, -1}, {0xFFFE, 0x0001, 0},
  };
  for (const auto &row : rows) {
    CAPTURE(row.good);
    CAPTURE(row.wanted);
    const Radio radio = movedThese(static_cast<uint16_t>(row.good));
    Calibration calibration = filled(0xA5);
    uint8_t channel = NoChannel;
    const Refusal refusal = radio.calibrator.finish(static_cast<uint16_t>(row.wanted), calibration, channel);
    if (row.channel < 0) {
      CHECK(refusal == Refusal::None);
      CHECK(channel == NoChannel);
      CHECK(sbus::stateOf(calibration) == StoredState::Good);
    } else {
      CHECK(refusal == Refusal::HardlyMoved);
      CHECK(channel == row.channel);
      CHECK(bytesOf(calibration) == bytesOf(filled(0xA5)));
    }
  }
}

TEST_CASE("finish gives each reason of result, for the channel that has it") {
  const struct {
    Extent travel, rest;
    Refusal refusal;
  } rows[] = {
      {{800, 1199}, {1000, 1000}, Refusal::HardlyMoved},
      {{172, 1811}, {900, 1000}, Refusal::NotStill},
      {{992, 1811}, {500, 500}, Refusal::CentreOutside},
      {{172, 1811}, {400, 400}, Refusal::NotCentred},
      {{172, 1811}, {992, 992}, Refusal::NotPushed},
  };
  for (const auto &row : rows) {
    Radio radio = moved(row.travel, row.rest);
    radio.calibrator.high();
    radio.feed();
    Calibration calibration = filled(0);
    uint8_t channel = NoChannel;
    CHECK(radio.calibrator.finish(0x0001, calibration, channel) == row.refusal);
    CHECK(channel == 0);
  }
  const Radio radio;
  Calibration calibration = filled(0);
  uint8_t channel = NoChannel;
  CHECK(radio.calibrator.finish(0x0400, calibration, channel) == Refusal::NeverSeen);
  CHECK(channel == 10);
  CHECK(bytesOf(calibration) == bytesOf(filled(0)));
}

TEST_CASE("each refusal has words of its own that stand behind a channel's name, and None has none") {
  std::vector<std::string> seen;
  for (const Refusal refusal :
       {Refusal::NeverSeen, Refusal::HardlyMoved, Refusal::CentreOutside, Refusal::NotStill, Refusal::NotCentred,
        Refusal::NotPushed}) {
    const std::string words = text(refusal);
    CAPTURE(words);
    CHECK(words.size() > 8);
    CHECK(words.size() < 64);
    CHECK(words[0] == ' ');
    for (const char c : words) {
      CHECK((c == ' ' || (c >= 'a' && c <= 'z')));
    }
    for (const std::string &other : seen) {
      CHECK(words != other);
    }
    seen.push_back(words);
  }
  CHECK(std::string(text(Refusal::None)).empty());
  CHECK(std::string(text(static_cast<Refusal>(200))).empty());
}

TEST_CASE("whatever sticks a radio has, -1000, 0 and +1000 are exactly at their three points, through 132 bytes") {
  CHECK(rc::check("calibrated == what the sticks are", [] {
    struct Stick {
      uint16_t low, rest, high, jitter;
      bool atEnd, backwards;
    };
    std::array<Stick, 16> sticks;
    for (Stick &stick : sticks) {
      const auto length = *rc::gen::inRange<int>(400, 2048);
      const auto low = *rc::gen::inRange<int>(0, 2048 - length);
      stick.atEnd = *rc::gen::inRange<int>(0, 4) == 0;
      stick.backwards = *rc::gen::arbitrary<bool>();
      const int rest = stick.atEnd ? (stick.backwards ? length : 0)
                                   : *rc::gen::inRange<int>((length + 3) / 4 + 1, length - (length + 3) / 4);
      stick.jitter = static_cast<uint16_t>(stick.atEnd ? 0 : *rc::gen::inRange<int>(0, 17));
      stick.low = static_cast<uint16_t>(low);
      stick.rest = static_cast<uint16_t>(low + rest);
      stick.high = static_cast<uint16_t>(low + length);
    }
    Radio radio;
    const auto feed = [&](auto value) {
      for (size_t i = 0; i < sticks.size(); i++) {
        radio.channels[i] = static_cast<uint16_t>(value(sticks[i]));
      }
      radio.feed();
      radio.feedAll(*rc::gen::arbitrary<uint16_t>(), true, false);
      radio.feedAll(*rc::gen::arbitrary<uint16_t>(), false, true);
    };
    for (unsigned i = 0; i < 5; i++) {
      feed([](const Stick &stick) { return *rc::gen::inRange<int>(stick.low, stick.high + 1); });
    }
    feed([](const Stick &stick) { return stick.high; });
    feed([](const Stick &stick) { return stick.low; });
    radio.calibrator.centre();
    feed([](const Stick &stick) { return stick.rest + stick.jitter; });
    feed([](const Stick &stick) { return stick.rest - stick.jitter; });
    radio.calibrator.high();
    feed([](const Stick &stick) { return stick.backwards ? stick.low : stick.high; });

    Calibration stored = filled(0xFF);
    uint8_t channel = NoChannel;
    RC_ASSERT(radio.calibrator.finish(0xFFFF, stored, channel) == Refusal::None);
    RC_ASSERT(channel == NoChannel);
    const auto bytes = bytesOf(stored);
    Calibration calibration = filled(0);
    std::memcpy(&calibration, bytes.data(), bytes.size());
    RC_ASSERT(sbus::stateOf(calibration) == StoredState::Good);
    for (size_t i = 0; i < sticks.size(); i++) {
      const Stick &stick = sticks[i];
      const CalibratedChannel &found = calibration.channels[i];
      const int sign = stick.backwards ? -1 : 1;
      RC_ASSERT(found.toNormalised(stick.low) == -1000 * sign);
      RC_ASSERT(found.toNormalised(stick.high) == 1000 * sign);
      RC_ASSERT(found.toMicroseconds(stick.low) == 1500 - 512 * sign);
      RC_ASSERT(found.toMicroseconds(stick.high) == 1500 + 512 * sign);
      if (stick.atEnd) {
        RC_ASSERT(found.toNormalised(stick.rest) == -1000);
        RC_ASSERT(found.range.centre == (stick.low + stick.high + 1) / 2);
      } else {
        for (int raw = stick.rest - stick.jitter; raw <= stick.rest + stick.jitter; raw++) {
          RC_ASSERT(found.toNormalised(static_cast<uint16_t>(raw)) == 0);
          RC_ASSERT(found.toMicroseconds(static_cast<uint16_t>(raw)) == 1500);
        }
      }
    }
  }));
}

TEST_CASE("whatever comes in whatever step, what is found can be") {
  CHECK(rc::check("None means possible, a refusal that nothing was touched", [] {
    Radio radio;
    radio.calibrator.setDeadZone(*rc::gen::arbitrary<uint16_t>());
    const auto steps = *rc::gen::container<std::vector<uint8_t>>(rc::gen::arbitrary<uint8_t>());
    const bool narrow = *rc::gen::arbitrary<bool>();
    for (const uint8_t step : steps) {
      if (step < 4) {
        radio.calibrator.begin();
      } else if (step < 20) {
        radio.calibrator.centre();
      } else if (step < 30) {
        radio.calibrator.high();
      }
      for (uint16_t &value : radio.channels) {
        value = narrow ? *rc::gen::inRange<uint16_t>(980, 1010) : *rc::gen::element<uint16_t>(0, 172, 992, 1811, 65535);
      }
      radio.feed(step % 16 == 0, step % 16 == 1);
    }
    for (uint8_t i = 0; i < 16; i++) {
      CalibratedChannel found = {{0, 0, 0}, 0};
      const Refusal refusal = radio.calibrator.result(i, found);
      RC_ASSERT(sbus::isPossible(found));
      RC_ASSERT(sbus::isCalibrated(found) == (refusal == Refusal::None));
    }
    const auto wanted = *rc::gen::arbitrary<uint16_t>();
    Calibration calibration = filled(0x5A);
    uint8_t channel = NoChannel;
    const Refusal refusal = radio.calibrator.finish(wanted, calibration, channel);
    if (refusal == Refusal::None) {
      RC_ASSERT(sbus::stateOf(calibration) == StoredState::Good);
    } else {
      RC_ASSERT((wanted >> channel & 1) != 0);
      RC_ASSERT(radio.refusal(channel) == refusal);
      RC_ASSERT(bytesOf(calibration) == bytesOf(filled(0x5A)));
    }
  }));
}
