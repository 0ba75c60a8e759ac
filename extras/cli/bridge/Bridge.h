// Forwards the frames of a line while they are fresh, and failsafe frames otherwise: for `bridge`, and for `send` of a
// live line.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "cli/Input.h"
#include "cli/SilenceNote.h"
#include "cli/bridge/FrameOutput.h"
#include "cli/bridge/FrameRules.h"
#include "cli/options/SourceOption.h"
#include "line/Observer.h"
#include "line/Statistics.h"

namespace tool {

// What happens to the frames.
struct BridgeOptions {
  BridgeOptions() = default;  // nothing: they keep their bytes
  explicit BridgeOptions(Subcommand &subcommand) : rules(subcommand), keepsEnd(false) {}

  FrameRules rules;
  bool keepsEnd = true;  // the end byte; otherwise 00
};

struct Receiver {
  explicit Receiver(const SourceOption &option);

  const SourceOption &source;
  const std::unique_ptr<Input> input;
  SilenceNote silence;
  line::Observer observer;
  uint64_t freshUs = 0;  // the end of the newest frame that may leave
};

// Chooses one of two receivers: the second only while the first has no link.
class TwoReceivers {
 public:
  // Takes a frame of receiver 0 or 1.
  void put(size_t receiver, uint64_t nowUs, const line::Values &values) {
    if (values.failsafe) {
      _goodUs[receiver] = 0;
    } else if (!values.lostFrame) {
      _goodUs[receiver] = nowUs;
    }
    choose(nowUs);
  }

  // Returns true if a frame without a flag came within the last 0.1 s, and no failsafe frame since.
  bool isGood(size_t receiver, uint64_t nowUs) const {
    return _goodUs[receiver] > 0 && nowUs < _goodUs[receiver] + GoodForUs;
  }

  // Returns the receiver chosen at `nowUs`, which may be a little earlier than in the previous call. The choice stays
  // while neither is good.
  size_t choose(uint64_t nowUs) {
    const bool isFirst = isGood(0, nowUs), isSecond = isGood(1, nowUs);
    _firstSinceUs = !isFirst ? 0 : _firstSinceUs == 0 ? nowUs : _firstSinceUs;
    if (_chosen == 0) {
      _chosen = !isFirst && isSecond && nowUs >= GoodForUs ? 1 : 0;  // at the start, wait for the first
    } else if (isFirst && (!isSecond || nowUs >= _firstSinceUs + BackUs)) {
      _chosen = 0;
    }
    return _chosen;
  }

 private:
  static constexpr uint64_t GoodForUs = 100000;
  static constexpr uint64_t BackUs = 1000000;  // the first has been good for so long before it is chosen again

  size_t _chosen = 0;
  std::array<uint64_t, 2> _goodUs{};  // time of the newest frame without a flag; 0: none, or failsafe since
  uint64_t _firstSinceUs = 0;         // the first has been good since then; 0: it is not
};

class Bridge {
 public:
  // `second`: another receiver, or null. `to`: see FrameOutput. Throws std::runtime_error.
  Bridge(BridgeOptions &options, Receiver &first, Receiver *second, const std::string &to);
  Bridge(const Bridge &) = delete;
  Bridge &operator=(const Bridge &) = delete;

  // See Destination.
  bool waitForReader() const { return _output.waitForReader(_receivers[0]->input->seconds()); }

  // Forwards frames until the receivers end. Throws std::runtime_error, also if a live line ends that should not.
  void run();

 private:
  Input::Taker taker(size_t i);
  void take(size_t i, const line::Stretch &stretch);
  void tick(Receiver &receiver, uint64_t nowUs);
  size_t chosen(uint64_t nowUs);
  bool haveEnded() const;
  bool isBroken() const;
  bool fill(uint64_t nowUs);
  void send(line::Stretch::Kind kind, const line::Character &last, uint8_t flags);

  BridgeOptions &_options;
  Receiver *const _receivers[2];
  const std::string _to;
  FrameOutput _output;
  TwoReceivers _choice;
  const bool _isText;
  const bool _hasTimes;
  size_t _chosen = 0;
  uint64_t _sentUs = 0;
  uint8_t _end = 0;  // the newest frame's end byte
};

}  // namespace tool
