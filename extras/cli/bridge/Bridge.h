// Forwards the frames of a line while they are fresh, and failsafe frames otherwise: for `bridge`, and for `send` of a
// live line.
#pragma once

#include <algorithm>
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
#include "sbus/LinkQuality.h"
#include "sbus/ReceiverChoice.h"

namespace tool {

// What happens to the frames.
struct BridgeOptions {
  BridgeOptions() = default;  // nothing: they keep their bytes
  explicit BridgeOptions(Subcommand &subcommand) : rules(subcommand), keepsEnd(false) {}

  FrameRules rules;
  bool keepsEnd = true;  // the end byte; otherwise 00
};

// What was heard of a receiver.
struct Heard {
  line::Observer observer;
  uint64_t freshUs = 0;  // the end of the newest frame that may leave
  sbus::LinkQuality quality;
  sbus::Reception reception{};
  const char *misfit = nullptr;  // what the one that flies sends instead; null while both fit
  bool isMisfitSaid = false;
};

// Which of two receivers flies, by the rules that boards have.
class Choice {
 public:
  // Judges both, and chooses one: with a trainer the teacher's, the first. Call it for each frame and each tick.
  void judge(Heard &first, Heard &second, sbus::Trainer *trainer, uint64_t nowUs) {
    _nowUs = std::max(_nowUs, nowUs);
    const Heard &flying = this->flying() == 0 ? first : second;
    for (Heard *const each : {&first, &second}) {
      const sbus::LinkState state = each->observer.state(_nowUs);
      each->misfit = misfit(*each, flying);
      each->reception = {each->freshUs > 0 && each->misfit == nullptr ? state : sbus::LinkState::NeverSeen,
                         static_cast<unsigned long>((_nowUs - each->freshUs) / 1000),
                         each->quality.update(each->observer.counters(), state, static_cast<uint32_t>(_nowUs))};
    }
    const auto ms = static_cast<uint32_t>(_nowUs / 1000);
    if (trainer != nullptr) {
      trainer->hear(second.reception, ms);
    } else {
      _choice.choose({first.reception, second.reception}, ms);
    }
  }

  size_t flying() const { return _choice.flying(); }

 private:
  static const char *misfit(const Heard &one, const Heard &other) {
    const bool isSize = one.freshUs > 0 && other.freshUs > 0 && one.observer.has24() != other.observer.has24();
    const bool isRange = sbus::haveOtherRanges(one.observer.newest().raw.data(), other.observer.newest().raw.data());
    return isSize ? "another number of channels" : isRange ? "the other make's range" : nullptr;
  }

  sbus::ReceiverChoice<2> _choice;
  uint64_t _nowUs = 0;  // the latest: the two are not in step to the microsecond
};

struct Receiver : Heard {
  explicit Receiver(const SourceOption &option);

  const SourceOption &source;
  const std::unique_ptr<Input> input;
  SilenceNote silence;
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
  void judge(uint64_t nowUs);
  bool haveEnded() const;
  bool isBroken() const;
  bool fill(uint64_t nowUs);
  void send(line::Stretch::Kind kind, const line::Character &last, uint8_t flags);

  BridgeOptions &_options;
  Receiver *const _receivers[2];
  const std::string _to;
  FrameOutput _output;
  Choice _choice;
  const bool _isText;
  const bool _hasTimes;
  uint64_t _sentUs = 0;
  uint8_t _end = 0;  // the newest frame's end byte
};

}  // namespace tool
