// --trainer of `sbus bridge`: a switch on the teacher's radio hands channels over to the pupil's.
#pragma once

#include <string>
#include <vector>

#include "cli/options/Scanner.h"
#include "cli/options/Subcommand.h"
#include "line/Statistics.h"

namespace tool {

class TrainerOption {
 public:
  TrainerOption() = default;  // as if it were not given
  // Adds the option to a subcommand.
  explicit TrainerOption(Subcommand &subcommand) {
    _option =
        subcommand.option("--trainer", _text, "while this channel is on, CH1 to CH4, or these, come from --second");
    _option.type("CH[=CH,...]");
  }
  TrainerOption(const TrainerOption &) = delete;
  TrainerOption &operator=(const TrainerOption &) = delete;

  bool given() const { return _option.given(); }

  // Reads the option. Rejects the command line if it is wrong.
  void read(const sbus::Range &range) {
    if (!given()) {
      return;
    }
    Scanner scanner("--trainer", _text);
    _switch = scanner.channel(sbus::ProportionalCount) - 1;
    _range = range;
    _channels = {0, 1, 2, 3};
    if (scanner.take("=")) {
      _channels.clear();
      do {
        _channels.push_back(scanner.channel(sbus::ProportionalCount) - 1);
      } while (scanner.take(","));
    }
    scanner.end(_channels.empty() ? "=" : "a comma or the end");
  }

  // Copies the pupil's channels into the teacher's frame while the switch is on.
  void apply(line::Values &teacher, const line::Values &pupil) const {
    if (sbus::toNormalised(teacher.raw[_switch], _range) > OnAbove) {
      for (const size_t channel : _channels) {
        teacher.raw[channel] = pupil.raw[channel];
      }
    }
  }

 private:
  static constexpr int16_t OnAbove = 500;  // +50 %: the middle of a three-position switch is off

  std::string _text;
  Option _option;
  size_t _switch = 0;
  sbus::Range _range = sbus::FrSky;
  std::vector<size_t> _channels;
};

}  // namespace tool
