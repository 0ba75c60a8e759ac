// The options of `sbus bridge` that change a frame: --trainer, --map, --limit, and --failsafe without a link.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/options/Subcommand.h"
#include "line/Statistics.h"
#include "sbus/Frame.h"
#include "sbus/Link.h"
#include "sbus/Scaling.h"
#include "sbus/Trainer.h"

namespace tool {

class FrameRules {
 public:
  FrameRules() = default;  // changes nothing
  // Adds the options to a subcommand.
  explicit FrameRules(Subcommand &subcommand);
  FrameRules(const FrameRules &) = delete;
  FrameRules &operator=(const FrameRules &) = delete;

  // Reads the options. Rejects the command line if one is wrong.
  void read(const sbus::Range &range);

  // Returns the rule of --trainer; null without it.
  sbus::Trainer *trainer() { return _trainer ? &*_trainer : nullptr; }

  // Changes the raw values by --map, then --limit; the first is CH1.
  void apply(uint16_t *raw) const;

  // Changes a frame that is sent in this state of the link; `isExtra`: one with header 2F. Returns false if nothing is
  // to be sent.
  bool applyFailsafe(sbus::LinkState state, bool isExtra, line::Values &values);

 private:
  struct MapSource {
    size_t channel;  // counted from 0
    bool isReversed;
  };
  struct Limit {
    size_t channel;  // counted from 0
    uint16_t low, high;
  };

  void readTrainer();
  void readMap();
  void readLimits();
  void readFailsafe();

  std::string _trainerText;
  Option _trainerOption;
  std::optional<sbus::Trainer> _trainer;
  std::string _map;
  std::string _limit;
  std::string _failsafe;
  Option _failsafeOption;
  sbus::Range _range = sbus::FrSky;
  std::vector<MapSource> _sources;  // of CH1, CH2 ...
  std::vector<Limit> _limits;
  std::vector<std::pair<size_t, uint16_t>> _failsafeValues;  // raw values of channels, counted from 0
  line::Values _held[2];  // of the newest frame with a link, and of that with header 2F; count 0: no such frame yet
};

}  // namespace tool
