// sbus bridge: changes each accepted frame and forwards it: trainer, two receivers, hardware-in-the-loop tests.

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <memory>
#include <optional>

#include "cli/Latency.h"
#include "cli/Output.h"
#include "cli/SilenceNote.h"
#include "cli/bridge/ChannelRules.h"
#include "cli/bridge/FailsafeOption.h"
#include "cli/bridge/FrameOutput.h"
#include "cli/bridge/TrainerOption.h"
#include "cli/bridge/TwoReceivers.h"
#include "cli/options/RangeOption.h"
#include "cli/options/SourceOption.h"
#include "cli/subcommands/Subcommands.h"
#include "line/Format.h"
#include "line/Observer.h"

namespace tool {

namespace {

using Kind = line::Stretch::Kind;

struct Options {
  explicit Options(Subcommand &subcommand)
      : source(subcommand, Playback::RealTime, Rows::Rejected),
        rules(subcommand),
        failsafe(subcommand),
        trainer(subcommand),
        range(subcommand) {}

  SourceOption source;
  ChannelRules rules;
  FailsafeOption failsafe;
  TrainerOption trainer;
  RangeOption range;
  std::string to;
  std::string second;
  double backS = 1;
  Option back;
  bool latency = false;
};

struct Receiver {
  explicit Receiver(const SourceOption &option)
      : source(option), input(option.open()), silence(option.name(), "frames") {
    observer.reset(0, input->settings().characterUs());
  }

  const SourceOption &source;
  const std::unique_ptr<Input> input;
  SilenceNote silence;
  line::Observer observer;
  Latency latency;
};

class Bridge {
 public:
  Bridge(Options &options, Receiver &first, Receiver *second)
      : _options(options),
        _receivers{&first, second},
        _output(options.to, first.input->settings()),
        _choice(static_cast<uint64_t>(options.backS * 1e6)),
        _hasTimes(first.source.hasTimes() && (second == nullptr || second->source.hasTimes())) {
    for (const size_t i : {size_t{0}, size_t{1}}) {
      if (_receivers[i] != nullptr) {
        _receivers[i]->observer.listen([this, i](const line::Stretch &stretch) { take(i, stretch); });
      }
    }
  }
  Bridge(const Bridge &) = delete;
  Bridge &operator=(const Bridge &) = delete;

  Input::Taker taker(size_t i) {
    Receiver &receiver = *_receivers[i];
    return {[&receiver](const line::Character &character) {
              receiver.latency.read();
              receiver.observer.put(character);
            },
            [this, &receiver](uint64_t nowUs) { tick(receiver, nowUs); }};
  }

  std::string summary() const { return _output.summary(); }

 private:
  static constexpr uint64_t FillUs = 9000;  // the period of the paper's receiver
  static constexpr uint64_t OldUs = 100000;

  // Returns true for a frame that may have waited for 0.1 s while the PC was busy or the program was stopped. A pipe
  // may deliver the bytes of a file all at once.
  static bool isOld(const Receiver &receiver, const line::Stretch &frame) {
    const uint32_t lateUs = receiver.source.isStream() ? 0 : frame.characters.back().lateUs;
    return frame.endUs() + OldUs < receiver.input->nowUs() + lateUs;
  }

  void take(size_t i, const line::Stretch &stretch) {
    Receiver &receiver = *_receivers[i];
    bool isSent = false;
    if (stretch.isFrame() && !isOld(receiver, stretch)) {
      if (stretch.kind != Kind::Extra) {
        _choice.put(i, stretch.endUs(), receiver.observer.newest());
      }
      if (i == chosen(stretch.endUs())) {
        isSent = send(stretch.kind, stretch.endUs(), stretch.characters[sbus::FlagsIndex].value);
      }
    }
    receiver.latency.passed(stretch.characters.size(), isSent && _options.latency);
  }

  void tick(Receiver &receiver, uint64_t nowUs) {
    receiver.observer.idleUntil(receiver.input->knownUs());
    receiver.silence.tick(nowUs, receiver.observer.counters().frames > 0);
    receiver.latency.tick();
    const bool waits = _output.tick();
    if (fill(nowUs) || waits) {
      receiver.input->hurry();
    }
  }

  // With --trainer, always chooses the teacher's receiver.
  size_t chosen(uint64_t nowUs) {
    const size_t chosen = _options.trainer.given() || _receivers[1] == nullptr ? 0 : _choice.choose(nowUs);
    if (chosen != _chosen) {
      std::fprintf(stderr, "%.3f s: %s %s\n", static_cast<double>(nowUs) / 1e6,
                   _receivers[chosen]->source.name().c_str(), chosen == 0 ? "has its link back" : "takes over");
      _chosen = chosen;
    }
    return chosen;
  }

  // The end of a file or a pipe is no silence of the line.
  bool haveEnded() const {
    return std::all_of(std::begin(_receivers), std::end(_receivers),
                       [](const Receiver *receiver) { return receiver == nullptr || receiver->input->hasEnded(); });
  }

  // While no frames arrive, sends the newest values with both flags, like a receiver without a link. Returns true if
  // it has to.
  bool fill(uint64_t nowUs) {
    line::Observer &observer = _receivers[chosen(nowUs)]->observer;
    if (observer.newest().count == 0 || observer.state(nowUs) != sbus::LinkState::Stale || haveEnded()) {
      return false;
    }
    if (nowUs >= _sentUs + FillUs) {
      send(observer.has24() ? Kind::Frame24 : Kind::Frame, nowUs, 0);
    }
    return true;
  }

  // Sends the newest values of the chosen receiver; a frame with header 2F has its own `flags`. Returns true if nothing
  // delayed them.
  bool send(Kind kind, uint64_t nowUs, uint8_t flags) {
    Receiver &receiver = *_receivers[_chosen];
    const sbus::LinkState state = receiver.observer.state(nowUs);
    const line::Values &newest = receiver.observer.newest();
    BridgedFrame frame{kind, _hasTimes ? std::optional<uint64_t>(nowUs) : std::nullopt,
                       kind == Kind::Extra ? line::withFlags(newest, flags) : newest};
    if (_options.trainer.given() && receiver.observer.hasLink(nowUs) && _choice.isGood(1, nowUs)) {
      _options.trainer.apply(frame.values, _receivers[1]->observer.newest());
    }
    _options.rules.apply(frame.values.raw.data());
    _sentUs = nowUs;
    return _options.failsafe.apply(state, kind == Kind::Extra, frame.values) && _output.put(frame);
  }

  Options &_options;
  Receiver *const _receivers[2];
  FrameOutput _output;
  TwoReceivers _choice;
  const bool _hasTimes;
  size_t _chosen = 0;
  uint64_t _sentUs = 0;
};

void run(Options &options) {
  const sbus::Range range = options.range.range();
  options.source.setRange(range);
  options.rules.read(range);
  options.failsafe.read(range);
  options.trainer.read(range);
  if (options.trainer.given() && options.second.empty()) {
    rejectCommandLine("--trainer: --second is the pupil's receiver; name it");
  }
  if (options.back.given() && (options.trainer.given() || options.second.empty())) {
    rejectCommandLine(options.trainer.given() ? "--back: the teacher's receiver is always used; leave it out"
                                              : "--back: --second is the other receiver; name it");
  }
  std::optional<SourceOption> second;
  if (!options.second.empty()) {
    second.emplace(options.source, options.second);
  }
  Receiver first(options.source);
  std::optional<Receiver> other;
  if (second) {
    other.emplace(*second);
  }
  if (options.to == "-") {
    write(options.source.json().line());
  }
  Bridge bridge(options, first, other ? &*other : nullptr);
  std::fprintf(stderr, "%s: forwarding its frames; Ctrl-C ends it\n", options.source.name().c_str());
  const Input::Taker taker = bridge.taker(0);
  if (other) {
    Input::runBoth(*first.input, taker, *other->input, bridge.taker(1));
  } else {
    first.input->run(taker.put, taker.tick);
  }
  std::fprintf(stderr, "%s\n", bridge.summary().c_str());
  if (options.latency) {
    std::fprintf(stderr, "%s\n", first.latency.text("frame").c_str());
  }
  flush();
  first.silence.end(first.observer.counters().frames + (other ? other->observer.counters().frames : 0) > 0);
}

}  // namespace

void addBridge(CLI::App &app) {
  Subcommand subcommand(app, "bridge", "changes each frame and forwards it: trainer, two receivers, tests in the loop");
  const auto options = std::make_shared<Options>(subcommand);
  subcommand
      .option("DEVICE", options->to, "a serial port; - for JSON lines; without it, a pseudo-terminal (prints its name)")
      .notEmpty()
      .type("");
  subcommand.option("--second", options->second, "a second receiver, used while the first has no link")
      .notEmpty()
      .type("SOURCE");
  options->back =
      subcommand.option("--back", options->backS, "how long the first must have its link before it is used again (1)")
          .between(0, 60)
          .type("S");
  subcommand.flag("--latency", options->latency,
                  "print at the end the time from reading a frame's last byte to writing the frame");
  subcommand.footer(
      "Only accepted frames are sent, each at once, with their flags; the end byte is 00, and telemetry is left out. "
      "While no frames come, bridge sends the newest values every 9 ms with the lost-frame and failsafe flags. A "
      "serial port's TXD must be inverted to drive a flight controller.");
  subcommand.run([options] { run(*options); });
}

}  // namespace tool
