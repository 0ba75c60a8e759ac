// sbus bridge: forwards each accepted frame: trainer, two receivers, hardware-in-the-loop tests.

#include <cstdio>
#include <memory>
#include <optional>

#include "cli/bridge/Bridge.h"
#include "cli/options/RangeOption.h"
#include "cli/options/SourceOption.h"
#include "cli/subcommands/Subcommands.h"

namespace tool {

namespace {

struct Options {
  explicit Options(Subcommand &subcommand)
      : source(subcommand, Playback::RealTime, Rows::Rejected), bridge(subcommand), range(subcommand) {}

  SourceOption source;
  BridgeOptions bridge;
  RangeOption range;
  std::string to;
  std::string second;
};

void run(Options &options) {
  const sbus::Range range = options.range.range();
  options.source.setRange(range);
  options.bridge.rules.read(range);
  if (options.bridge.rules.trainer() != nullptr && options.second.empty()) {
    rejectCommandLine("--trainer: --second is the pupil's receiver; name it");
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
  Bridge bridge(options.bridge, first, other ? &*other : nullptr, options.to);
  std::fprintf(stderr, "%s: forwarding its frames; Ctrl-C ends it\n", options.source.name().c_str());
  bridge.run();
}

}  // namespace

void addBridge(CLI::App &app) {
  Subcommand subcommand(app, "bridge", "forwards each frame: trainer, two receivers, tests in the loop");
  const auto options = std::make_shared<Options>(subcommand);
  subcommand
      .option("DEVICE", options->to, "a serial port; - for JSON lines; without it, a pseudo-terminal (prints its name)")
      .notEmpty()
      .type("");
  subcommand.option("--second", options->second, "a second receiver, used while it is the better one")
      .notEmpty()
      .type("SOURCE");
  subcommand.footer(
      "Only accepted frames are sent, each at once, with their flags; the end byte is 00, and telemetry is left out. "
      "No frame older than 0.1 s is sent: while no fresh ones come, bridge sends the newest values every 9 ms with the "
      "lost-frame and failsafe flags. A serial port's TXD must be inverted to drive a flight controller.");
  subcommand.run([options] { run(*options); });
}

}  // namespace tool
