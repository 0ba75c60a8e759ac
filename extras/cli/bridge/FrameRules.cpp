#include "cli/bridge/FrameRules.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cli/options/CsvColumn.h"
#include "cli/options/Scanner.h"
#include "line/file/TableReader.h"
#include "line/file/Units.h"
#include "line/recording/Words.h"

namespace tool {

namespace {

// Returns the nearest raw value for a part of the travel in percent.
uint16_t rawFrom(double percent, const sbus::Range &range) {
  const double one = line::valueOf(0, line::Unit::Percent, range), other = line::valueOf(sbus::ChannelMax, line::Unit::Percent, range);
  return *line::rawOf(std::min(std::max(percent, std::min(one, other)), std::max(one, other)), line::Unit::Percent, range);
}

// Takes "ch3=" of a rule for a channel that none of `rules` is for. `again`: what is expected if one is.
template <typename Rule>
size_t newChannel(Scanner &scanner, const std::vector<Rule> &rules, const char *again) {
  const size_t channel = scanner.channel(sbus::ProportionalCount) - 1;
  const bool isAgain =
      std::any_of(rules.begin(), rules.end(), [channel](const Rule &other) { return other.channel == channel; });
  if (isAgain || !scanner.take("=")) {
    scanner.expect(isAgain ? again : "=");
  }
  return channel;
}

}  // namespace

FrameRules::FrameRules(Subcommand &subcommand) {
  _trainerOption =
      subcommand.option("--trainer", _trainer, "while this channel is on, take CH1 to CH4, or these, from --second");
  _trainerOption.type("CH[=CH,...]");
  subcommand.option("--map", _map, "the channels of SOURCE that become CH1, CH2 ...; -3: reversed").type("CH,CH,...");
  subcommand
      .option("--mix", _mixTexts, "a sum of parts of the travel, such as ch1=ch1+0.5*ch2-10%; once for each channel")
      .once()
      .type("CH=SUM");
  subcommand.option("--limit", _limitTexts, "the ends of a channel, such as ch3=172..1500; once for each channel")
      .once()
      .type("CH=LOW..HIGH");
  _failsafeOption = subcommand.option(
      "--failsafe", _failsafe,
      "without a link, send nothing, the last values, or these values (SOURCE's own, with its flags)");
  _failsafeOption.type("off|hold|CH=VALUE,...");
}

void FrameRules::read(const sbus::Range &range) {
  _range = range;
  readTrainer();
  readMap();
  for (const std::string &text : _mixTexts) {
    _mixes.push_back(mixOf(text));
  }
  for (const std::string &text : _limitTexts) {
    _limits.push_back(limitOf(text));
  }
  readFailsafe();
}

void FrameRules::readTrainer() {
  if (!hasTrainer()) {
    return;
  }
  Scanner scanner("--trainer", _trainer);
  _switch = scanner.channel(Count) - 1;
  const bool areNamed = scanner.take("=");
  do {
    if (areNamed) {
      _handedOver.push_back(scanner.channel(Count) - 1);
    }
  } while (areNamed && scanner.take(","));
  _handedOver = areNamed ? _handedOver : std::vector<size_t>{0, 1, 2, 3};
  scanner.end("a comma or the end");
}

void FrameRules::readFailsafe() {
  if (!_failsafeOption.given() || _failsafe == "off" || _failsafe == "hold") {
    return;
  }
  line::forEachBetweenCommas(_failsafe, [&](std::string_view each) {
    const std::string word(each);
    const unsigned channel = channelOf(line::lower(word.substr(0, word.find('='))));
    if (channel == 0 || channel > sbus::ProportionalCount) {
      rejectCommandLine("--failsafe: off, hold or values of ch1 to ch16 such as ch3=172 are expected, not " + word);
    }
    line::FrameValues values;
    const std::string wrong = line::assign(word, _range, values);
    if (!wrong.empty()) {
      rejectCommandLine("--failsafe: " + wrong);
    }
    if (std::any_of(_failsafeValues.begin(), _failsafeValues.end(),
                    [&](const auto &other) { return other.first == channel - 1; })) {
      rejectCommandLine("--failsafe: " + line::quoted(word) + " sets a channel twice; leave one of them out");
    }
    _failsafeValues.emplace_back(channel - 1, values.raw[channel - 1]);
  });
}

void FrameRules::readMap() {
  Scanner scanner("--map", _map);
  double number = 0;
  for (bool more = !_map.empty(); more; more = scanner.take(",")) {
    const int sign = scanner.take("-") ? -1 : 1;
    if (!scanner.number(number) || number < 1 || number > Count || number != std::floor(number) ||
        _sources.size() == Count) {
      scanner.expect(_sources.size() == Count ? "the end after 16 channels" : "a channel, 1 to 16 or -1 to -16,");
    }
    _sources.push_back(sign * static_cast<int>(number));
  }
  scanner.end("a comma and a channel, such as ,-3,");
}

FrameRules::Mix FrameRules::mixOf(const std::string &text) const {
  Scanner scanner("--mix", text);
  Mix mix{newChannel(scanner, _mixes, "a channel that no other --mix sets")};
  double sign = scanner.take("-") ? -1 : 1;
  do {
    double part = 1;
    const bool isNumber = scanner.number(part);
    if (isNumber && scanner.take("%")) {
      mix.added += sign * part;
    } else {
      if (isNumber && !scanner.take("*")) {
        scanner.expect("* and a channel, or %,");
      }
      mix.parts[scanner.channel(Count) - 1] += sign * part;
    }
    sign = scanner.take("+") ? 1 : scanner.take("-") ? -1 : 0;
  } while (sign != 0);
  scanner.end("+, - or the end");
  return mix;
}

FrameRules::Limit FrameRules::limitOf(const std::string &text) const {
  Scanner scanner("--limit", text);
  Limit limit{newChannel(scanner, _limits, "a channel that no other --limit has"), 0, 0};
  limit.low = scanner.value(_range);
  if (!scanner.take("..")) {
    scanner.expect("..");
  }
  limit.high = scanner.value(_range);
  if (_range.low > _range.high && limit.low > limit.high) {
    std::swap(limit.low, limit.high);  // the range is reversed: -100 % has the higher raw value
  }
  if (limit.low > limit.high) {
    scanner.expect("a value of " + std::to_string(limit.low) + " or more");
  }
  scanner.end("the end");
  return limit;
}

// Mirrors the value at the centre, in proportion to the lengths of the two sides, also beyond the ends.
void FrameRules::reverse(uint16_t &raw) const {
  raw = sbus::fromNormalized(static_cast<int16_t>(-sbus::toNormalized(raw, _range)), _range);
}

void FrameRules::apply(uint16_t *raw) const {
  std::array<uint16_t, Count> from;
  std::copy_n(raw, Count, from.begin());
  for (size_t i = 0; i < _sources.size(); i++) {
    raw[i] = from[static_cast<size_t>(std::abs(_sources[i])) - 1];
    if (_sources[i] < 0) {
      reverse(raw[i]);
    }
  }
  std::copy_n(raw, Count, from.begin());
  for (const Mix &mix : _mixes) {
    double percent = mix.added;
    for (size_t i = 0; i < Count; i++) {
      percent += mix.parts[i] * line::valueOf(from[i], line::Unit::Percent, _range);
    }
    raw[mix.channel] = rawFrom(percent, _range);
  }
  for (const Limit &limit : _limits) {
    raw[limit.channel] = std::min(std::max(raw[limit.channel], limit.low), limit.high);
  }
}

void FrameRules::train(line::Values &teacher, const line::Values &pupil) const {
  constexpr int16_t OnAbove = 500;  // +50 %: the middle of a three-position switch is off
  if (sbus::toNormalized(teacher.raw[_switch], _range) > OnAbove) {
    for (const size_t channel : _handedOver) {
      teacher.raw[channel] = pupil.raw[channel];
    }
  }
}

bool FrameRules::applyFailsafe(sbus::LinkState state, bool isExtra, line::Values &values) {
  line::Values &held = _held[isExtra ? 1 : 0];
  const bool isStale = state == sbus::LinkState::Stale;
  if (!isStale && state != sbus::LinkState::Failsafe) {
    held = values;
    return true;
  }
  if (_failsafe == "hold" && held.count > 0) {
    values.raw = held.raw;
    values.switches = held.switches;
  }
  for (const auto &[channel, raw] : _failsafeValues) {
    values.raw[channel] = raw;
  }
  values.lostFrame = values.lostFrame || isStale;
  values.failsafe = values.failsafe || isStale || !_failsafe.empty();
  return _failsafe != "off";
}

}  // namespace tool
