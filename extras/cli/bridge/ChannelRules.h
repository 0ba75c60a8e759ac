// Changes CH1 to CH16 for `sbus bridge`: --map, then --mix, then --limit.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "cli/options/Subcommand.h"
#include "sbus/Frame.h"
#include "sbus/Scaling.h"

namespace tool {

class ChannelRules {
 public:
  ChannelRules() = default;  // changes nothing
  // Adds the options to a subcommand.
  explicit ChannelRules(Subcommand &subcommand);
  ChannelRules(const ChannelRules &) = delete;
  ChannelRules &operator=(const ChannelRules &) = delete;

  // Reads the options. Rejects the command line if one is wrong.
  void read(const sbus::Range &range);

  // Changes the raw values; the first is CH1.
  void apply(uint16_t *raw) const;

 private:
  static constexpr unsigned Count = sbus::ProportionalCount;

  struct Mix {
    size_t channel;
    std::array<double, Count> parts{};  // factor of each channel
    double added = 0;                   // percent
  };
  struct Limit {
    size_t channel;
    uint16_t low;
    uint16_t high;
  };

  void readMap();
  Mix mixOf(const std::string &text) const;
  Limit limitOf(const std::string &text) const;
  void reverse(uint16_t &raw) const;

  std::string _map;
  std::vector<std::string> _mixTexts;
  std::vector<std::string> _limitTexts;
  sbus::Range _range = sbus::FrSky;
  std::vector<int> _sources;  // for CH1, CH2 ...: a channel, counted from 1; negative: reversed
  std::vector<Mix> _mixes;
  std::vector<Limit> _limits;
};

}  // namespace tool
