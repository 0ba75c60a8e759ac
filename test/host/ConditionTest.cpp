// A condition of `sbus watch --when` and of the page's trigger: when it holds, and what is said about a text that is
// none.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "line/Condition.h"
#include "support/Watched.h"

namespace {

using line::Condition;
using line::Moment;

// 1250 us are raw 500 here, and 50 % are raw 1500.
double shown(unsigned, uint16_t raw, bool isPercent) { return isPercent ? (raw - 1000) / 10.0 : raw / 2 + 1000; }

// A line of 16 channels after a frame without flags, all at 1000.
Moment moment() {
  line::Observer observer;
  Moment moment(observer, 0, false);
  double channels[18];
  std::fill_n(channels, 18, 1000.0);
  channels[16] = channels[17] = 0;
  moment.setChannels(channels, 18);
  moment.values[Moment::State] = static_cast<double>(sbus::LinkState::Ok);
  moment.values[Moment::Quality] = 100;
  return moment;
}

Moment with(int which, double value) {
  Moment one = moment();
  one.values[which] = value;
  return one;
}

constexpr int Ch5 = 4;
constexpr int Ch17 = 16;

double state(sbus::LinkState state) { return static_cast<double>(state); }

}  // namespace

TEST_CASE("a condition holds for what it names, whatever the spelling, the blanks, the case and the unit") {
  const Moment lossy = with(Moment::State, state(sbus::LinkState::Lossy));
  const Moment stale = with(Moment::State, state(sbus::LinkState::Stale));
  Moment failsafe = with(Moment::Failsafe, 1);
  failsafe.values[Ch5] = 9;
  const struct {
    const char *text;
    Moment yes;
    Moment no;
  } table[] = {
      {"ch5 > 1500", with(Ch5, 1501), with(Ch5, 1500)},
      {"CH5>=1500 raw", with(Ch5, 1500), with(Ch5, 1499)},
      {"ch5<1250us", with(Ch5, 499), with(Ch5, 500)},
      {"ch5<1250 \xC2\xB5s", with(Ch5, 499), with(Ch5, 500)},
      {"ch5 <= -50.5 %", with(Ch5, 495), with(Ch5, 496)},
      {"ch5>+50percent", with(Ch5, 1501), with(Ch5, 1500)},
      {"ch5 = 1250us", with(Ch5, 501), with(Ch5, 502)},
      {"ch5 != 1250us", with(Ch5, 502), with(Ch5, 501)},
      {"ch5 == 7", with(Ch5, 7), with(Ch5, 8)},
      {"ch5 != 7", with(Ch5, 8), with(Ch5, 7)},
      {"ch17 = 1", with(Ch17, 1), with(Ch17 + 1, 1)},
      {"ch17", with(Ch17, 1), with(Ch17 + 1, 1)},
      {"!ch17", moment(), with(Ch17, 1)},
      {"ch17 && ok", with(Ch17, 1), moment()},
      {"failsafe", with(Moment::Failsafe, 1), with(Moment::LostFrame, 1)},
      {"failsafe", with(Moment::Failsafe, 1), with(Moment::State, state(sbus::LinkState::Failsafe))},
      {"nopulses", with(Moment::NoPulses, 1), with(Moment::Failsafe, 1)},
      {"No Pulses", with(Moment::NoPulses, 1), moment()},
      {"failsafe || no pulses", with(Moment::NoPulses, 1), with(Moment::LostFrame, 1)},
      {"LOSTFRAME", with(Moment::LostFrame, 1), with(Moment::Failsafe, 1)},
      {"lost frame", with(Moment::LostFrame, 1), moment()},
      {"not lostframe", moment(), with(Moment::LostFrame, 1)},
      {"rejected", with(Moment::Rejected, 1), moment()},
      {"state = lossy", lossy, moment()},
      {"state==failsafe", with(Moment::State, state(sbus::LinkState::Failsafe)), with(Moment::Failsafe, 1)},
      {"lossy", lossy, stale},
      {"stale", stale, lossy},
      {"ok", moment(), lossy},
      {"state != ok", stale, moment()},
      {"age>50ms", with(Moment::Age, 50001), with(Moment::Age, 50000)},
      {"age >= 0.05 s", with(Moment::Age, 50000), with(Moment::Age, 49999)},
      {"age < 2 s", with(Moment::Age, 1999999), with(Moment::Age, 2000000)},
      {"quality<80%", with(Moment::Quality, 79), with(Moment::Quality, 80)},
      {"failsafe or ch5 > 5 and ch5 < 9", with(Ch5, 6), with(Ch5, 9)},
      {"failsafe || ch5 > 5 && ch5 < 9", failsafe, with(Ch5, 9)},
      {"(failsafe||ch5>5)&&ch5<9", with(Ch5, 6), failsafe},
      {"!(failsafe || ch5 > 5)", with(Ch5, 5), failsafe},
      {"!!!failsafe", moment(), failsafe},
  };
  for (const auto &each : table) {
    CAPTURE(each.text);
    const Condition condition(each.text, shown);
    CHECK(condition.error().text == "");
    CHECK(condition.holds(each.yes));
    CHECK_FALSE(condition.holds(each.no));
  }
}

TEST_CASE("what does not come fulfils no comparison, and before the first frame only rejected bytes fulfil anything") {
  for (const char *text : {"ch24 > 0", "ch24 < 1", "ch24 != 5", "ch24 = 0"}) {
    CAPTURE(text);
    CHECK_FALSE(Condition(text, shown).holds(moment()));
  }
  Moment none = with(Moment::State, state(sbus::LinkState::NeverSeen));
  CHECK_FALSE(Condition("!failsafe", shown).holds(none));
  none.values[Moment::Rejected] = 1;
  CHECK(Condition("rejected", shown).holds(none));
}

TEST_CASE("a board's numbers are compared as they are printed") {
  CHECK(Condition("ch5 > -12.5", nullptr).holds(with(Ch5, -12)));
  CHECK_FALSE(Condition("ch5 >= 3000", nullptr).holds(moment()));
  CHECK(Condition("ch5 < -1.5 || ch5 > 50%", shown, true).holds(with(Ch5, -2)));
  CHECK(Condition("ch5 > 1500us", nullptr).error().at == 10);
}

TEST_CASE("an error names its place and what is expected there") {
  constexpr const char *name =
      "a channel such as ch5, failsafe, nopulses, lostframe, rejected, jump, ok, lossy, stale, state, age, quality, ! "
      "or ( is expected";
  constexpr const char *sign = "<, <=, >, >=, = or != is expected";
  constexpr const char *value = "a value, 0 to 2047, a pulse such as 1500us or a part such as -50%, is expected";
  constexpr const char *age = "a time with its unit, such as 50ms or 0.05s, is expected";
  const std::string deep(40, '(');
  const struct {
    const char *text;
    size_t at;
    size_t length;
    const char *error;
  } table[] = {
      {"", 0, 0, name},
      {"  ", 0, 0, name},
      {"chair", 0, 5, name},
      {"failsafe && ch33>1", 12, 4, "a channel from ch1 to ch32 is expected"},
      {"ch0 = 1", 0, 3, "a channel from ch1 to ch32 is expected"},
      {"ch5", 3, 0, sign},
      {"ch5 ? 3", 4, 1, sign},
      {"ch5 > 3000", 6, 4, value},
      {"ch5 > ", 5, 0, value},
      {"ch5 > soon", 6, 4, value},
      {"ch5 > 1500 volt", 11, 4, "&&, || or the end is expected"},
      {"failsafe & ok", 9, 1, "&&, || or the end is expected"},
      {"failsafe)", 8, 1, "&&, || or the end is expected"},
      {"(failsafe", 9, 0, "&&, || or ) is expected"},
      {"(failsafe ok", 10, 2, "&&, || or ) is expected"},
      {"!", 1, 0, name},
      {"state > ok", 6, 1, "= or != is expected"},
      {"state = fine", 8, 4, "ok, lossy, stale or failsafe is expected"},
      {"lost", 4, 0, "frame is expected"},
      {"ch5 > 2047", 6, 4, value},
      {"ch5 < 0 || ok", 6, 1, value},
      {"ch5 > 9999us || ok", 6, 4, value},
      {"age>soon", 4, 4, age},
      {"age > 50", 6, 2, age},
      {"age > 50 && ok", 6, 2, age},
      {"quality<x", 8, 1, "a number of percent is expected"},
      {deep.c_str(), 31, 1, "a condition with fewer parentheses is expected"},
  };
  for (const auto &each : table) {
    CAPTURE(each.text);
    const Condition::Error error = Condition(each.text, shown).error();
    CHECK(error.text == each.error);
    CHECK(error.at == each.at);
    CHECK(error.length == each.length);
  }
}

TEST_CASE("the deepest condition that is read is judged right") {
  std::string text = "ch5=7";
  for (int i = 0; i < 15; i++) {
    text = "failsafe || ok && !(" + text + ")";
  }
  const Condition condition(text, shown);
  REQUIRE(condition.error().text == "");
  CHECK(condition.holds(with(Ch5, 8)));
  CHECK_FALSE(condition.holds(with(Ch5, 7)));
}

TEST_CASE("a moment has an observer's values: channels, switches, flags, state, age and quality") {
  Watched line;
  line.frame(1000, false, true);
  Moment moment(line.observer, line.us + 50000, true);
  CHECK(moment.values[0] == 1000);
  CHECK(moment.values[Ch17] == 1);
  CHECK(std::isnan(moment.values[18]));
  CHECK(moment.values[Moment::LostFrame] == 1);
  CHECK(moment.values[Moment::Failsafe] == 0);
  CHECK(moment.values[Moment::Rejected] == 1);
  CHECK(moment.values[Moment::Age] == 56000);
  line.frame(500, true);
  CHECK(Moment(line.observer, line.us, false).values[Moment::Failsafe] == 1);
  CHECK(Moment(line.observer, line.us + 200000, false).values[Moment::Failsafe] == 1);
  CHECK(Moment(line.observer, line.us + 200000, false).values[Moment::State] == state(sbus::LinkState::Stale));
}
