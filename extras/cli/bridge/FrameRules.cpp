#include "cli/bridge/FrameRules.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "line/file/TableReader.h"
#include "line/file/Units.h"
#include "line/recording/Words.h"

namespace tool {

namespace {

// Returns the channel of this name, counted from 0. If it is not one of ch1 to ch16, rejects the command line: `wrong`.
size_t channelOr(const std::string &wrong, std::string_view name) {
  const unsigned channel = line::channelOf(line::lower(name));
  if (channel == 0 || channel > sbus::ProportionalCount) {
    rejectCommandLine(wrong);
  }
  return channel - 1;
}

uint8_t trainersChannel(std::string_view word) {
  const std::string wrong = "--trainer: channels of ch1 to ch16, such as ch8 or ch8=ch1,ch2, are expected, not ";
  return static_cast<uint8_t>(channelOr(wrong + line::quoted(word), word));
}

}  // namespace

FrameRules::FrameRules(Subcommand &subcommand) {
  _trainerOption = subcommand.option("--trainer", _trainerText,
                                     "while this channel is on, take CH1 to CH4, or these, from --second");
  _trainerOption.type("CH[=CH,...]");
  subcommand.option("--map", _map, "the channels of SOURCE that become CH1, CH2 ...; -3: CH3 reversed").type("N,N,...");
  subcommand.option("--limit", _limit, "the ends of channels, such as ch3=172..1500").type("CH=LOW..HIGH,...");
  _failsafeOption = subcommand.option(
      "--failsafe", _failsafe,
      "without a link, send nothing, the last values, or these values (SOURCE's own, with its flags)");
  _failsafeOption.type("off|hold|CH=VALUE,...");
}

void FrameRules::read(const sbus::Range &range) {
  _range = range;
  readTrainer();
  readMap();
  readLimits();
  readFailsafe();
}

void FrameRules::readTrainer() {
  if (!_trainerOption.given()) {
    return;
  }
  const std::string_view text = _trainerText;
  const size_t sign = text.find('=');
  unsigned handedOver = sign == text.npos ? 0xF : 0;  // CH1 to CH4
  if (sign != text.npos) {
    line::forEachBetweenCommas(text.substr(sign + 1),
                               [&](std::string_view word) { handedOver |= 1u << trainersChannel(word); });
  }
  _trainer.emplace(trainersChannel(text.substr(0, sign)), static_cast<uint16_t>(handedOver), _range);
}

void FrameRules::readMap() {
  if (_map.empty()) {
    return;
  }
  line::forEachBetweenCommas(_map, [&](std::string_view word) {
    const bool isReversed = !word.empty() && word[0] == '-';
    size_t channel = 0;
    if (!line::parseWhole(word.substr(isReversed ? 1 : 0), channel) || channel == 0 ||
        channel > sbus::ProportionalCount || _sources.size() == sbus::ProportionalCount) {
      rejectCommandLine("--map: up to 16 channels, 1 to 16 or reversed -1 to -16, such as 2,1,-3, are expected, not " +
                        line::quoted(word));
    }
    _sources.push_back({channel - 1, isReversed});
  });
}

void FrameRules::readLimits() {
  if (_limit.empty()) {
    return;
  }
  line::forEachBetweenCommas(_limit, [&](std::string_view word) {
    const std::string wrong =
        "--limit: the lower and the upper end of ch1 to ch16, each once, such as ch3=172..1500 or "
        "ch3=-100%..50%, are expected, not " +
        line::quoted(word);
    const size_t sign = word.find('='), dots = word.find("..");
    const size_t channel = channelOr(wrong, word.substr(0, sign));
    const bool isWhole = sign != word.npos && dots != word.npos && dots > sign;
    const auto low =
        isWhole ? line::parseValue(std::string(word.substr(sign + 1, dots - sign - 1)), _range) : std::nullopt;
    const auto high = isWhole ? line::parseValue(std::string(word.substr(dots + 2)), _range) : std::nullopt;
    const bool isAgain =
        std::any_of(_limits.begin(), _limits.end(), [&](const Limit &other) { return other.channel == channel; });
    const bool isTurned = _range.low > _range.high;  // -100 % has the higher raw value
    if (!low || !high || isAgain || (*low > *high && !isTurned)) {
      rejectCommandLine(wrong);
    }
    _limits.push_back({channel, std::min(*low, *high), std::max(*low, *high)});
  });
}

// A reversed value is mirrored at the centre, in proportion to the lengths of the two sides, also beyond the ends.
void FrameRules::apply(uint16_t *raw) const {
  std::array<uint16_t, sbus::ProportionalCount> from{};
  std::copy_n(raw, from.size(), from.begin());
  for (size_t i = 0; i < _sources.size(); i++) {
    const uint16_t value = from[_sources[i].channel];
    raw[i] = !_sources[i].isReversed
                 ? value
                 : sbus::fromNormalized(static_cast<int16_t>(-sbus::toNormalized(value, _range)), _range);
  }
  for (const Limit &limit : _limits) {
    raw[limit.channel] = std::clamp(raw[limit.channel], limit.low, limit.high);
  }
}

void FrameRules::readFailsafe() {
  if (!_failsafeOption.given() || _failsafe == "off" || _failsafe == "hold") {
    return;
  }
  line::forEachBetweenCommas(_failsafe, [&](std::string_view each) {
    const std::string word(each);
    const size_t channel =
        channelOr("--failsafe: off, hold or values of ch1 to ch16 such as ch3=172 are expected, not " + word,
                  each.substr(0, each.find('=')));
    line::FrameValues values;
    const std::string wrong = line::assign(word, _range, values);
    if (!wrong.empty()) {
      rejectCommandLine("--failsafe: " + wrong);
    }
    if (std::any_of(_failsafeValues.begin(), _failsafeValues.end(),
                    [&](const auto &other) { return other.first == channel; })) {
      rejectCommandLine("--failsafe: " + line::quoted(word) + " sets a channel twice; leave one of them out");
    }
    _failsafeValues.emplace_back(channel, values.raw[channel]);
  });
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
