// Finds out what a radio sends: ends, centre and dead zone of a channel, what is rejected at each limit, what each step
// remembers, and what finish() returns.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <initializer_list>
#include <string>
#include <vector>

#include "sbus/Calibrator.h"
#include "support/BitByBit.h"
#include "support/ShowArrays.h"

namespace {

// A Calibrator, and a radio with moving sticks, which are fed to it as a sketch would.

struct Extent {
  int low, high;
};

struct Radio {
  static constexpr uint16_t Rest = 992;
  static constexpr uint8_t NoChannel = 99;

  // Low, centre, high and dead zone.
  using Numbers = std::array<uint16_t, 4>;
  static constexpr Numbers NotTouched = {11, 22, 33, 44};

  sbus::Calibrator calibrator;
  Channels channels;  // all rest, except those that are moved
  bool backwards = false;

  Radio() { channels.fill(Rest); }

  // Moves CH1 through its travel, lets it rest, and holds it at its high end, or at its low end if it rests less than
  // 1/4 below the high end.
  Radio(Extent travel, Extent rest, int deadZone = -1) : Radio() {
    if (deadZone >= 0) {
      calibrator.setDeadZone(static_cast<uint16_t>(deadZone));
    }
    move({travel.low, travel.high});
    calibrator.centre();
    move({rest.low, rest.high});
    const int low = travel.low < travel.high ? travel.low : travel.high;
    const int high = travel.low < travel.high ? travel.high : travel.low;
    backwards = high - rest.low <= (high - low) / 4;
    calibrator.high();
    hold(backwards ? low : high);
  }

  void feed() { calibrator.feed(channels.data(), false, false); }

  void feed(int frames) {
    while (frames-- > 0) {
      feed();
    }
  }

  // CH1.
  void stay(int value, int frames) {
    channels[0] = static_cast<uint16_t>(value);
    feed(frames);
  }
  void move(std::initializer_list<int> values) {
    for (const int value : values) {
      stay(value, sbus::Calibrator::SeenFrames);
    }
  }
  void hold(int value) { stay(value, 100); }  // long enough to forget any place before

  sbus::CalibrationError error(uint8_t channel = 0) const {
    sbus::CalibratedChannel found;
    return calibrator.result(channel, found);
  }

  static Numbers numbersOf(const sbus::CalibratedChannel &channel) {
    return {channel.range.low, channel.range.centre, channel.range.high, channel.deadZone};
  }
  Numbers found(uint8_t channel = 0) const {
    sbus::CalibratedChannel found = {{NotTouched[0], NotTouched[1], NotTouched[2]}, NotTouched[3]};
    calibrator.result(channel, found);
    return numbersOf(found);
  }
};

// The result of finish(), and the calibration afterwards; it was all A5 before.
struct Finished {
  sbus::Calibration calibration;
  uint8_t channel = Radio::NoChannel;
  sbus::CalibrationError error;

  Finished(const sbus::Calibrator &calibrator, unsigned wanted) {
    std::memset(&calibration, 0xA5, sizeof calibration);
    error = calibrator.finish(static_cast<uint16_t>(wanted), calibration, channel);
  }
  Radio::Numbers operator[](size_t index) const { return Radio::numbersOf(calibration.channels[index]); }
  bool isGood() const { return sbus::stateOf(calibration) == sbus::StoredState::Good; }
  bool isTouched() const {
    uint8_t filled[sizeof calibration];
    std::memset(filled, 0xA5, sizeof filled);
    return std::memcmp(&calibration, filled, sizeof filled) != 0;
  }
};

}  // namespace

using sbus::CalibrationError;
using Numbers = Radio::Numbers;

TEST_CASE(
    "a channel is rejected, on either side of each limit; a centre that is not required is in the travel's middle") {
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

TEST_CASE(
    "result() returns what is still to be done in each step; a step forgets the later steps; frames with a flag do not "
    "count") {
  constexpr Numbers Forwards = {172, 1000, 1811, 20};
  constexpr Numbers Backwards = {1811, 1000, 172, 20};
  constexpr Numbers None = Radio::NotTouched;
  constexpr int Centre = -1, High = -2, Begin = -3;  // calls; 0 and more are values of CH1
  const struct {
    std::vector<int> steps;
    CalibrationError error;
    Numbers found;
  } rows[] = {
      {{}, CalibrationError::NeverSeen, None},
      {{172}, CalibrationError::HardlyMoved, None},
      {{172, 700}, CalibrationError::MovedOneWay, None},
      {{172, 1350}, CalibrationError::MovedOneWay, None},
      {{172, 1351}, CalibrationError::NotRested, None},
      {{1811, 699}, CalibrationError::NotRested, None},
      {{1811, 700}, CalibrationError::MovedOneWay, None},
      {{172, 1811}, CalibrationError::NotRested, None},
      {{172, 1811, Centre}, CalibrationError::NotRested, None},
      {{172, 1811, Centre, 1000}, CalibrationError::NotPushed, None},
      {{172, 1811, Centre, 1000, High}, CalibrationError::NotHeld, None},
      {{172, 1811, Centre, 1000, High, 1811}, CalibrationError::None, Forwards},
      {{172, 1811, Centre, 1000, High, 172}, CalibrationError::None, Backwards},
      {{172, 1811, Centre, 1000, High, 172, 1811}, CalibrationError::None, Forwards},
      {{172, 1811, Centre, 1000, High, 1811, 172}, CalibrationError::None, Backwards},
      {{172, 1811, Centre, 1000, High, 172, 1000}, CalibrationError::NotPushed, None},
      {{172, 1811, Centre, 1000, High, 172, High}, CalibrationError::NotHeld, None},
      {{172, 1811, Centre, 1000, High, 1811, High, 172}, CalibrationError::None, Backwards},
      {{Centre, 1000}, CalibrationError::NeverSeen, None},
      {{172, 1811, High, 172}, CalibrationError::NotRested, None},
      {{172, 1811, Centre, 400, 1600}, CalibrationError::NotStill, None},
      {{172, 1811, Centre, 400, 1600, Centre}, CalibrationError::NotRested, None},
      {{172, 1811, Centre, 400, 1600, Centre, 1000, High, 1811}, CalibrationError::None, Forwards},
      {{172, 1811, Centre, 400, High, 172, Centre, 1000}, CalibrationError::NotPushed, None},
      {{0, 2047, Begin}, CalibrationError::NeverSeen, None},
      {{0, 2047, Begin, 172, 1811, Centre, 1000, High, 1811}, CalibrationError::None, Forwards},
      {{0, 2047, Centre, 0, 2047, Begin, 172, 1811}, CalibrationError::NotRested, None},
      {{0, 2047, Centre, 0, 2047, High, 0, Begin, 172, 1811, Centre, 1000, High, 172},
       CalibrationError::None,
       Backwards},
  };
  for (const auto &row : rows) {
    INFO("row ", &row - rows);
    Radio radio;
    radio.calibrator.setDeadZone(20);
    const auto lostFrames = [&radio] {
      for (const unsigned flags : {1u, 2u, 3u}) {
        Channels lost;
        lost.fill(flags == 1 ? 0 : 2047);
        for (int i = 0; i < 100; i++) {
          radio.calibrator.feed(lost.data(), (flags & 1) != 0, (flags & 2) != 0);
        }
      }
    };
    bool high = false;
    for (const int step : row.steps) {
      lostFrames();
      if (step >= 0 && high) {
        radio.hold(step);
      } else if (step >= 0) {
        radio.move({step});
      } else if (step == Centre) {
        radio.calibrator.centre();
      } else if (step == High) {
        radio.calibrator.high();
      } else {
        radio.calibrator.begin();
      }
      high = step == High || (step >= 0 && high);
    }
    lostFrames();
    CHECK(radio.found() == row.found);
    CHECK(radio.error() == row.error);
    CHECK(Finished(radio.calibrator, 0x0001).error == row.error);
  }
}

TEST_CASE("a channel held more than 1/4 of its travel below its resting place is reversed; less is no push") {
  const struct {
    const char *what;
    int rest;
    int held;
    CalibrationError error;
    Numbers found;  // also if it is not required
  } rows[] = {
      {"at its high end", 1000, 1800, CalibrationError::None, {200, 1000, 1800, 8}},
      {"stays, as a switch does", 1000, 1000, CalibrationError::NotPushed, {200, 1000, 1800, 8}},
      {"falls by 1/4", 1000, 600, CalibrationError::NotPushed, {200, 1000, 1800, 8}},
      {"... and one", 1000, 599, CalibrationError::None, {1800, 1000, 200, 8}},
      {"rises by 1/4", 1000, 1400, CalibrationError::NotPushed, {200, 1000, 1800, 8}},
      {"... and one", 1000, 1401, CalibrationError::None, {200, 1000, 1800, 8}},
      {"1/16 beyond its low end", 1000, 100, CalibrationError::None, {1800, 1000, 100, 8}},
      {"... and one", 1000, 99, CalibrationError::CentreOutside, {0, 0, 0, 0}},
      {"1/16 beyond its high end", 1000, 1900, CalibrationError::None, {200, 1000, 1900, 8}},
      {"... and one", 1000, 1901, CalibrationError::CentreOutside, {0, 0, 0, 0}},
      {"beyond 2047", 1000, 65535, CalibrationError::CentreOutside, {0, 0, 0, 0}},
      {"a throttle that rises", 200, 1800, CalibrationError::None, {200, 1000, 1800, 0}},
      {"a throttle that stays low", 200, 200, CalibrationError::NotPushed, {200, 1000, 1800, 0}},
      {"a throttle that is low at its high values, and falls", 1800, 200, CalibrationError::None, {1800, 1000, 200, 0}},
      {"off its middle, falls by 1/4: all there is", 600, 200, CalibrationError::NotPushed, {200, 600, 1800, 8}},
  };
  for (const auto &row : rows) {
    CAPTURE(row.what);
    Radio radio({200, 1800}, {row.rest, row.rest});
    radio.calibrator.high();
    radio.hold(row.held);
    CHECK(radio.error() == row.error);
    CHECK(radio.found() == (row.error == CalibrationError::None ? row.found : Radio::NotTouched));
    const Finished finished(radio.calibrator, 0x0000);
    const bool any = row.error != CalibrationError::CentreOutside;
    CHECK(finished.error == (any ? CalibrationError::None : row.error));
    CHECK((!any || finished[0] == row.found));
    CHECK(Finished(radio.calibrator, 0x0001).error == row.error);
  }
}

TEST_CASE("a channel is held after 64 frames within 32 counts; two wrong frames at the end do no harm, three do") {
  const struct {
    const char *what;
    int jitter, frames, wrong, after;
    CalibrationError error;
  } rows[] = {
      {"63 frames", 0, 63, 0, 0, CalibrationError::NotHeld},
      {"64 frames", 0, 64, 0, 0, CalibrationError::None},
      {"jitters by 32", 32, 64, 0, 0, CalibrationError::None},
      {"jitters by 33", 33, 64, 0, 0, CalibrationError::NotHeld},
      {"two wrong ones", 0, 80, 2, 0, CalibrationError::None},
      {"two wrong ones, one frame too early", 0, 79, 2, 0, CalibrationError::NotHeld},
      {"three wrong ones", 0, 300, 3, 0, CalibrationError::NotHeld},
      {"... and 8 right ones", 0, 300, 3, 8, CalibrationError::None},
  };
  for (const auto &row : rows) {
    for (const int wrong : {0, 2047}) {
      CAPTURE(row.what);
      Radio radio({172, 1811}, {992, 992});
      radio.calibrator.high();
      for (int i = 0; i < row.frames; i++) {
        radio.stay(i % 2 == 0 ? 1800 : 1800 - row.jitter, 1);
      }
      radio.stay(wrong, row.wrong);
      radio.stay(1800, row.after);
      CHECK(radio.error() == row.error);
    }
  }
}

TEST_CASE("a wrong frame cancels eight good ones, and the first nine good ones hold a place that it does not change") {
  const struct {
    int before, after;  // good frames, until the channel is held
  } rows[] = {{8, 64}, {9, 63}, {10, 62}, {12, 60}, {13, 59}, {71, 1}, {72, 0}};
  for (const auto &row : rows) {
    CAPTURE(row.before);
    Radio radio({172, 1811}, {992, 992});
    radio.calibrator.high();
    radio.stay(1800, row.before);
    radio.stay(0, 1);
    if (row.after != 0) {
      radio.stay(1800, row.after - 1);
      CHECK(radio.error() == CalibrationError::NotHeld);
      radio.stay(1800, 1);
    }
    CHECK(radio.error() == CalibrationError::None);
  }
}

TEST_CASE("finish() names the first bad required channel, or stores all good channels and leaves the others empty") {
  const struct {
    unsigned good, required;
    int channel;  // -1: none
  } rows[] = {
      {0xFFFF, 0xFFFF, -1}, {0x0000, 0x0000, 0},  {0x0000, 0xFFFF, 0},  {0x0000, 0x8000, 15}, {0x7FFF, 0xFFFF, 15},
      {0x7FFF, 0x7FFF, -1}, {0x000F, 0x001F, 4},  {0x000F, 0x000F, -1}, {0xFFF0, 0x0008, 3},  {0x0FF0, 0xFFF0, 12},
      {0xFEFF, 0xFFFF, 8},  {0xA5C3, 0x0001, -1}, {0x0001, 0x0001, -1}, {0xFFFE, 0x0001, 0},  {0x8000, 0x0000, -1},
  };
  for (const auto &row : rows) {
    INFO("good ", row.good, ", required ", row.required);
    Radio radio;
    for (const uint16_t value : {uint16_t{172}, uint16_t{1811}, Radio::Rest, uint16_t{1810}}) {
      if (value == Radio::Rest) {
        radio.calibrator.centre();
      } else if (value == 1810) {
        radio.calibrator.high();
      }
      for (unsigned i = 0; i < 16; i++) {
        radio.channels[i] = (row.good >> i & 1) != 0 ? value : Radio::Rest;
      }
      radio.feed(sbus::Calibrator::HeldFrames);
    }
    const Finished finished(radio.calibrator, row.required);
    CHECK(finished.error == (row.channel < 0 ? CalibrationError::None : CalibrationError::HardlyMoved));
    CHECK(finished.channel == (row.channel < 0 ? Radio::NoChannel : row.channel));
    CHECK(finished.isTouched() == (row.channel < 0));
    CHECK(finished.isGood() == (row.channel < 0));
    for (unsigned i = 0; i < 16 && row.channel < 0; i++) {
      CHECK(finished[i] == ((row.good >> i & 1) != 0 ? Numbers{172, 992, 1811, 8} : Numbers{0, 0, 0, 0}));
    }
  }
  CHECK(Finished(Radio().calibrator, 0x0400).error == CalibrationError::NeverSeen);
}

TEST_CASE("without the third step finish() rejects, whatever is required") {
  Radio radio;
  radio.channels.fill(172);
  radio.feed(sbus::Calibrator::SeenFrames);
  radio.channels.fill(1811);
  radio.feed(sbus::Calibrator::SeenFrames);
  radio.calibrator.centre();
  radio.channels.fill(Radio::Rest);
  radio.feed(sbus::Calibrator::SeenFrames);
  for (const bool begun : {false, true}) {
    for (const unsigned required : {0x0000u, 0x0001u, 0xFFFFu}) {
      CAPTURE(required);
      const Finished finished(radio.calibrator, required);
      CHECK(finished.error == (begun ? CalibrationError::NotHeld : CalibrationError::NotPushed));
      CHECK(finished.channel == 0);
      CHECK_FALSE(finished.isTouched());
    }
    radio.calibrator.high();
  }
}
