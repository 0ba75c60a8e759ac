#include "line/Condition.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "line/capture/Parsing.h"

namespace line {

namespace {

using Step = Condition::Step;

constexpr int NestingMax = 30;  // of ! and parentheses: each holds at most two of the 64 results in holds()

struct Name {
  const char *name;
  Step step;
};

constexpr Step stateIs(sbus::LinkState state) {
  return {Moment::State, static_cast<double>(state), static_cast<double>(state)};
}
// The state failsafe comes first; alone, the word means the flag.
constexpr Name Names[] = {{"failsafe", stateIs(sbus::LinkState::Failsafe)},
                          {"ok", stateIs(sbus::LinkState::Ok)},
                          {"lossy", stateIs(sbus::LinkState::Lossy)},
                          {"stale", stateIs(sbus::LinkState::Stale)},
                          {"failsafe", {Moment::Failsafe, 1, 1}},
                          {"nopulses", {Moment::NoPulses, 1, 1}},
                          {"lostframe", {Moment::LostFrame, 1, 1}},
                          {"jump", {Moment::Jump, 1, 1}},
                          {"rejected", {Moment::Rejected, 1, 1}}};
constexpr size_t StateCount = 4;

constexpr const char *StateNames = "ok, lossy, stale or failsafe is expected";
constexpr const char *AllNames =
    "a channel such as ch5, failsafe, nopulses, lostframe, rejected, jump, ok, lossy, stale, state, age, quality, ! or "
    "( is expected";
constexpr const char *Value = "a value, 0 to 2047, a pulse such as 1500us or a part such as -50%, is expected";

bool isLetter(char c) { return (c >= 'a' && c <= 'z') || !isAscii(c); }

// Returns the size of the word, number or sign at the beginning of the text.
size_t tokenSize(std::string_view text) {
  const char *at = text.data();
  double number = 0;
  if (text.empty() || takeNumber(at, text.data() + text.size(), number)) {
    return static_cast<size_t>(at - text.data());
  }
  for (const std::string_view sign : {"<=", ">=", "==", "!=", "&&", "||"}) {
    if (text.substr(0, 2) == sign) {
      return 2;
    }
  }
  const auto letters = std::find_if_not(text.begin(), text.end(), isLetter);
  return letters == text.begin() ? 1
                                 : static_cast<size_t>(std::find_if_not(letters, text.end(), isDigit) - text.begin());
}

// Each function returns false after an error.
class Parser {
 public:
  Parser(std::string_view text, const Condition::Shown &shown, bool anyNumber, std::vector<Step> &steps,
         Condition::Error &error)
      : _text(lower(text)), _shown(shown), _anyNumber(anyNumber), _steps(steps), _error(error) {
    next();
  }

  void all() { either() && (_token.empty() || fail("&&, || or the end is expected")); }

 private:
  bool either() {
    bool good = both();
    while (good && (take("||") || take("or"))) {
      good = both() && add({Step::Or});
    }
    return good;
  }

  bool both() {
    bool good = single();
    while (good && (take("&&") || take("and"))) {
      good = single() && add({Step::And});
    }
    return good;
  }

  bool single() {
    const bool isNot = take("!") || take("not");
    if (!isNot && !take("(")) {
      return named();
    }
    if (++_nesting > NestingMax) {
      return fail("a condition with fewer parentheses is expected");
    }
    const bool good = isNot ? single() && add({Step::Not}) : either() && (take(")") || fail("&&, || or ) is expected"));
    _nesting--;
    return good;
  }

  bool named() {
    Step step{Moment::Age};
    if (take("age")) {
      return range(step, "a time with its unit, such as 50ms or 0.05s, is expected") && inUs(step) && add(step);
    }
    if (take("quality")) {
      step.which = Moment::Quality;
      return range(step, "a number of percent is expected") && (take("%"), add(step));
    }
    if (take("state")) {
      const bool outside = take("!=");
      return outside || take("==") || take("=") ? name(&Names[0], &Names[StateCount], outside, StateNames)
                                                : fail("= or != is expected");
    }
    if (take("lost")) {
      return take("frame") ? add({Moment::LostFrame, 1, 1}) : fail("frame is expected");
    }
    if (take("no")) {
      return take("pulses") ? add({Moment::NoPulses, 1, 1}) : fail("pulses is expected");
    }
    const bool isChannel = _token.size() > 2 && _token.substr(0, 2) == "ch" && isDigit(_token[2]);
    return isChannel ? channel() : name(std::begin(Names) + 1, std::end(Names), false, AllNames);
  }

  bool name(const Name *begin, const Name *end, bool outside, const char *expected) {
    const Name *const found = std::find_if(begin, end, [this](const Name &each) { return take(each.name); });
    if (found == end) {
      return fail(expected);
    }
    Step step = found->step;
    step.outside = outside;
    return add(step);
  }

  // A switch may stand alone.
  bool channel() {
    double number = 0;
    parseNumber(_token.substr(2), number);
    if (number < 1 || number > int{Moment::ChannelsEnd}) {
      return fail("a channel from ch1 to ch32 is expected");
    }
    next();
    Step step{static_cast<uint8_t>(number - 1), 0, 0, true};
    const bool isSwitch = number > sbus::ProportionalCount && number <= sbus::ChannelCount;
    const bool isAlone = _token.empty() || std::string_view("<>=!").find(_token[0]) == std::string_view::npos;
    return isSwitch && isAlone ? add(step) : range(step, Value) && inRaw(step) && add(step);
  }

  // Takes a sign and a number; `expected` describes the number.
  bool range(Step &step, const char *expected) {
    const std::string sign(_token);
    if (sign != "=" && sign != "==" && sign != "!=" && sign[0] != '<' && sign[0] != '>') {
      return fail("<, <=, >, >=, = or != is expected");
    }
    next();
    if (!parseNumber(_token, _number)) {
      return fail(expected);
    }
    _numberAt = {expected, _at, _token.size()};
    next();
    constexpr double Infinite = std::numeric_limits<double>::infinity();
    step.outside = sign == "!=";
    step.low = sign == ">" ? std::nextafter(_number, Infinite) : sign[0] == '<' ? -Infinite : _number;
    step.high = sign == "<" ? std::nextafter(_number, -Infinite) : sign[0] == '>' ? Infinite : _number;
    return true;
  }

  bool inUs(Step &step) {
    const double us = take("ms") ? 1e3 : take("s") ? 1e6 : 0;
    step.low *= us;
    step.high *= us;
    return us > 0 || failAtNumber();
  }

  // Takes the unit of a channel's range, and converts the range to raw values.
  bool inRaw(Step &step) {
    const bool isPercent = _token == "%" || _token == "percent";
    if (!isPercent && _token != "us" && _token != "\xC2\xB5s" && _token != "\xCE\xBCs") {
      take("raw");
      const bool isRaw = _number >= 0 && _number <= sbus::ChannelMax;
      return _anyNumber || (isRaw && step.low <= sbus::ChannelMax && step.high >= 0) || failAtNumber();
    }
    if (!_shown) {
      return fail("leave out us and %: a board's numbers are compared as printed");
    }
    next();
    std::optional<uint16_t> first;
    uint16_t last = 0;
    for (uint16_t raw = 0; raw <= sbus::ChannelMax; raw++) {
      const double value = _shown(step.which, raw, isPercent);
      if (value >= step.low && value <= step.high) {
        first = first.value_or(raw);
        last = raw;
      }
    }
    step.low = first.value_or(1);  // no value is in 1..0
    step.high = last;
    return first || step.outside || failAtNumber();
  }

  bool add(const Step &step) {
    _steps.push_back(step);
    return true;
  }

  void next() {
    const size_t end = _at + _token.size();
    _at = std::min(_text.find_first_not_of(" \t", end), _text.size());
    _token = std::string_view(_text).substr(_at);
    _token = _token.substr(0, tokenSize(_token));
    _at = _token.empty() ? end : _at;
  }

  bool take(std::string_view token) {
    const bool is = _token == token;
    if (is) {
      next();
    }
    return is;
  }

  bool fail(const char *text) {
    _error = {text, _at, _token.size()};
    return false;
  }

  bool failAtNumber() {
    _error = _numberAt;
    return false;
  }

  const std::string _text;
  const Condition::Shown &_shown;
  const bool _anyNumber;  // allow other numbers than raw values
  std::vector<Step> &_steps;
  Condition::Error &_error;
  std::string_view _token;  // the next one; empty at the end
  size_t _at = 0;
  double _number = 0;  // in the newest range
  Condition::Error _numberAt;
  int _nesting = 0;
};

}  // namespace

Moment::Moment(Observer &observer, uint64_t nowUs, bool isRejected) {
  const Values &newest = observer.newest();
  setChannels(newest.raw.data(), newest.count);
  if (newest.count == sbus::ProportionalCount) {
    std::copy(newest.switches.begin(), newest.switches.end(), values + sbus::ProportionalCount);
  }
  values[Age] = static_cast<double>(observer.ageUs(nowUs));
  values[Quality] = observer.linkQuality(nowUs);
  values[State] = static_cast<double>(observer.heldState(nowUs));
  values[Failsafe] = observer.inFailsafe();
  values[NoPulses] = newest.hasNoPulses();
  values[LostFrame] = newest.lostFrame;
  values[Rejected] = isRejected;
  values[Jump] = observer.jumped() != 0 && !isRejected;
}

Condition::Condition(std::string_view text, const Shown &shown, bool maybeBoard) {
  Parser(text, shown, maybeBoard || !shown, _steps, _error).all();
}

bool Condition::needsTime() const {
  return std::any_of(_steps.begin(), _steps.end(),
                     [](const Step &step) { return step.which >= Moment::Age && step.which <= Moment::State; });
}

bool Condition::holds(const Moment &moment) const {
  if (moment.values[Moment::State] == static_cast<double>(sbus::LinkState::NeverSeen) &&
      moment.values[Moment::Rejected] == 0) {
    return false;
  }
  uint64_t results = 0;  // bits; the newest is the lowest
  for (const Step &step : _steps) {
    if (step.which == Step::Not) {
      results ^= 1;
    } else if (step.which >= Moment::Count) {
      const bool isBoth = (results & 3) == 3;
      const bool isEither = (results & 3) != 0;
      results = results >> 2 << 1 | (step.which == Step::And ? isBoth : isEither);
    } else {
      const double value = moment.values[step.which];
      results = results << 1 | (!std::isnan(value) && (value >= step.low && value <= step.high) != step.outside);
    }
  }
  return (results & 1) != 0;
}

}  // namespace line
