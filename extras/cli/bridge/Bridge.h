// Forwards the frames of a line while they are fresh, and failsafe frames otherwise: for `bridge`, and for `send` of a
// live line.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "cli/Input.h"
#include "cli/SilenceNote.h"
#include "cli/bridge/Choice.h"
#include "cli/bridge/FrameOutput.h"
#include "cli/bridge/FrameRules.h"
#include "cli/options/SourceOption.h"
#include "line/Segments.h"

namespace tool {

// What happens to the frames.
struct BridgeOptions {
  BridgeOptions() = default;  // nothing: they keep their bytes
  explicit BridgeOptions(Subcommand &subcommand) : rules(subcommand), keepsEnd(false) {}

  FrameRules rules;
  bool keepsEnd = true;  // the end byte; otherwise 00
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
