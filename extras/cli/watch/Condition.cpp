#include "cli/watch/Condition.h"

#include "cli/options/CsvColumn.h"

namespace tool {

namespace {

constexpr const char *Names = "a channel such as ch5, failsafe, lostframe, ok, lossy, stale, age or quality, ! or (,";

double numberOf(Scanner &scanner, const char *what) {
  double number = 0;
  if (!scanner.number(number)) {
    scanner.expect(what);
  }
  return number;
}

}  // namespace

Condition::Condition(const char *option, const std::string &text, const sbus::Range &range) {
  Scanner scanner(option, text);
  _test = either(scanner, range);
  scanner.end("&&, || or the end");
}

bool Condition::holds(line::Observer &observer, uint64_t nowUs) const {
  const sbus::LinkState state = observer.state(nowUs);
  return state != sbus::LinkState::NeverSeen &&
         _test({observer.newest(), state, observer.ageUs(nowUs), observer.linkQuality(nowUs)});
}

Condition::Test Condition::either(Scanner &scanner, const sbus::Range &range) {
  Test test = both(scanner, range);
  while (scanner.take("||")) {
    test = [one = test, other = both(scanner, range)](const Now &now) { return one(now) || other(now); };
  }
  return test;
}

Condition::Test Condition::both(Scanner &scanner, const sbus::Range &range) {
  Test test = single(scanner, range);
  while (scanner.take("&&")) {
    test = [one = test, other = single(scanner, range)](const Now &now) { return one(now) && other(now); };
  }
  return test;
}

Condition::Test Condition::single(Scanner &scanner, const sbus::Range &range) {
  if (scanner.take("!")) {
    return [test = single(scanner, range)](const Now &now) { return !test(now); };
  }
  if (!scanner.take("(")) {
    return named(scanner, range);
  }
  const Test test = either(scanner, range);
  if (!scanner.take(")")) {
    scanner.expect("&&, || or )");
  }
  return test;
}

Condition::Test Condition::named(Scanner &scanner, const sbus::Range &range) {
  const std::string name = scanner.word();
  for (const auto &[word, state] : {std::pair<const char *, sbus::LinkState>{"failsafe", sbus::LinkState::Failsafe},
                                    {"ok", sbus::LinkState::Ok},
                                    {"lossy", sbus::LinkState::Lossy},
                                    {"stale", sbus::LinkState::Stale}}) {
    if (name == word) {
      return [is = state](const Now &now) { return now.state == is; };
    }
  }
  if (name == "lostframe") {
    return [](const Now &now) { return now.values.lostFrame; };
  }
  if (name == "age") {
    const Comparison compare = comparison(scanner);
    const double number = numberOf(scanner, "a time such as 50ms or 0.05, in seconds,");
    const double us = number * (scanner.take("ms") ? 1e3 : 1e6);
    return [compare, us](const Now &now) { return compare(static_cast<double>(now.ageUs), us); };
  }
  if (name == "quality") {
    const Comparison compare = comparison(scanner);
    const double percent = numberOf(scanner, "a number of percent");
    scanner.take("%");
    return [compare, percent](const Now &now) { return compare(now.quality, percent); };
  }
  const unsigned number = channelOf(name);
  if (number == 0) {
    scanner.expect(Names);
  }
  return channel(number, scanner, range);
}

// A switch may stand alone. What a line does not have fulfils no comparison.
Condition::Test Condition::channel(unsigned channel, Scanner &scanner, const sbus::Range &range) {
  const auto has = [channel](const line::Values &values) {
    return channel <= (values.count == sbus::ProportionalCount ? sbus::ChannelCount : values.count);
  };
  const bool maybeSwitch = channel > sbus::ProportionalCount && channel <= sbus::ChannelCount;
  if (maybeSwitch && !scanner.isNext("<>=!")) {
    return [channel, has](const Now &now) { return has(now.values) && valueOf(now.values, channel) != 0; };
  }
  const Comparison compare = comparison(scanner);
  const uint16_t raw = scanner.value(range);
  return [=](const Now &now) { return has(now.values) && compare(valueOf(now.values, channel), raw); };
}

Condition::Comparison Condition::comparison(Scanner &scanner) {
  if (scanner.take("<=")) {
    return std::less_equal<double>();
  }
  if (scanner.take("<")) {
    return std::less<double>();
  }
  if (scanner.take(">=")) {
    return std::greater_equal<double>();
  }
  if (scanner.take(">")) {
    return std::greater<double>();
  }
  if (scanner.take("==")) {
    return std::equal_to<double>();
  }
  if (scanner.take("!=")) {
    return std::not_equal_to<double>();
  }
  scanner.expect("<, <=, >, >=, == or !=");
}

}  // namespace tool
