// sbus send: sends a recording, the built-in receiver or values, to test a device that reads S.Bus.

#include <cstdio>
#include <memory>

#include "cli/Sending.h"
#include "cli/bridge/Bridge.h"
#include "cli/options/RangeOption.h"
#include "cli/options/SourceOption.h"
#include "cli/subcommands/Subcommands.h"

namespace tool {

namespace {

struct Options {
  explicit Options(Subcommand &subcommand)
      : source(subcommand, Playback::RealTime, Rows::Sent), sending(subcommand), range(subcommand) {
    source.addRows(subcommand);
  }

  SourceOption source;
  Sending sending;
  RangeOption range;
  double periodMs = 9;  // the paper's receiver
  double speed = 1;
  Option speedOption;
};

void sendLive(const Options &options) {
  BridgeOptions unchanged;
  Receiver receiver(options.source);
  Bridge bridge(unchanged, receiver, nullptr, options.sending.to());
  if (bridge.waitForReader()) {
    std::fprintf(stderr, "sending; Ctrl-C ends it\n");
    bridge.run();
  }
}

void run(Options &options) {
  const auto periodUs = static_cast<uint64_t>(options.periodMs * 1000);
  options.source.setRange(options.range.range());
  options.source.setPeriod(periodUs);
  const line::LineSettings settings = options.source.settings();
  if (periodUs <= sbus::FrameSize * settings.characterUs()) {
    rejectCommandLine(
        "--period: a frame takes 3 ms (1.5 ms at 200000 baud), and a gap follows; a longer period is expected");
  }
  options.source.rejectEmpty();
  if (options.source.isLive() && options.source.hasFrames()) {
    if (options.speedOption.given()) {
      rejectCommandLine("--speed: is for a recording; a live line has its own");
    }
    sendLive(options);
    return;
  }
  const std::unique_ptr<Input> input = options.source.open();
  input->setSpeed(options.speed);
  options.sending.run(*input);
}

}  // namespace

void addSend(CLI::App &app) {
  Subcommand subcommand(app, "send", "sends a recording, the built-in receiver, or values such as ch3=172");
  const auto options = std::make_shared<Options>(subcommand);
  subcommand.option("--period", options->periodMs, "the frame period of values and slow rows, in ms (9)")
      .between(1, 1000)
      .type("MS");
  options->speedOption =
      subcommand.option("--speed", options->speed, "send this many times as fast (1)").between(0.001, 1000).type("N");
  subcommand.footer(
      "Of a live line only frames are sent, and none older than 0.1 s: failsafe frames take their place. "
      "Values: ch1 to ch16 are raw, 0 to 2047, microseconds (1500us), percent (-50%), on (the high end) or off; "
      "ch17, ch18, failsafe and lostframe are on or off. A channel without a value is 992; CH3, the throttle, is "
      "172. A serial port's TXD must be inverted to drive a flight controller.");
  subcommand.run([options] { run(*options); });
}

}  // namespace tool
