// The steps of a calibration: what each remembers, when a channel counts as held in the third, and what finish()
// returns.
#include <doctest/doctest.h>

#include <vector>

#include "support/Radio.h"
#include "support/ShowArrays.h"

using sbus::CalibrationError;
using Numbers = Radio::Numbers;

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
      {{0, 2047, Centre, 0, 2047, High, 0, Begin, 172, 1811, Centre, 1000, High, 172}, CalibrationError::None, Backwards},
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

TEST_CASE("a channel that creeps by a count a frame is held all the while, however far from its first value it gets") {
  Radio radio({172, 1811}, {992, 992});
  radio.calibrator.high();
  for (int value = 1700; value < 1800; value++) {
    radio.stay(value, 1);
  }
  CHECK(radio.error() == CalibrationError::None);
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
