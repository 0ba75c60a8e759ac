#include "cli/bridge/FailsafeOption.h"

#include <algorithm>
#include <stdexcept>

#include "line/file/TableReader.h"
#include "cli/options/CsvColumn.h"
#include "line/recording/Words.h"

namespace tool {

FailsafeOption::FailsafeOption(Subcommand &subcommand) {
  _option = subcommand.option(
      "--failsafe", _text,
      "without a link, send nothing, the last values, or these values (SOURCE's own, with its flags)");
  _option.type("off|hold|CH=VALUE,...");
}

void FailsafeOption::read(const sbus::Range &range) {
  if (!_option.given() || _text == "off" || _text == "hold") {
    return;
  }
  line::forEachBetweenCommas(_text, [&](std::string_view each) {
    const std::string word(each);
    const unsigned channel = channelOf(line::lower(word.substr(0, word.find('='))));
    if (channel == 0 || channel > sbus::ProportionalCount) {
      rejectCommandLine("--failsafe: off, hold or values of ch1 to ch16 such as ch3=172 are expected, not " + word);
    }
    line::FrameValues values;
    const std::string wrong = line::assign(word, range, values);
    if (!wrong.empty()) {
      rejectCommandLine("--failsafe: " + wrong);
    }
    if (std::any_of(_set.begin(), _set.end(), [&](const auto &other) { return other.first == channel - 1; })) {
      rejectCommandLine("--failsafe: " + line::quoted(word) + " sets a channel twice; leave one of them out");
    }
    _set.emplace_back(channel - 1, values.raw[channel - 1]);
  });
}

bool FailsafeOption::apply(sbus::LinkState state, bool isExtra, line::Values &values) {
  line::Values &held = _held[isExtra ? 1 : 0];
  const bool isStale = state == sbus::LinkState::Stale;
  if (!isStale && state != sbus::LinkState::Failsafe) {
    held = values;
    return true;
  }
  if (_text == "hold" && held.count > 0) {
    values.raw = held.raw;
    values.switches = held.switches;
  }
  for (const auto &[channel, raw] : _set) {
    values.raw[channel] = raw;
  }
  values.lostFrame = values.lostFrame || isStale;
  values.failsafe = values.failsafe || isStale || !_text.empty();
  return _text != "off";
}

}  // namespace tool
