// sbus send: sends a recording, the built-in receiver or values, to test a device that reads S.Bus.

#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "cli/Destination.h"
#include "cli/Input.h"
#include "cli/bridge/Bridge.h"
#include "cli/options/RangeOption.h"
#include "cli/options/SourceOption.h"
#include "cli/options/Subcommand.h"
#include "cli/subcommands/Subcommands.h"

namespace tool {

namespace {

struct Options {
  explicit Options(Subcommand &subcommand) : source(subcommand, Playback::RealTime, Rows::Sent), range(subcommand) {
    source.addRows(subcommand);
  }

  SourceOption source;
  RangeOption range;
  std::string to;       // a port; empty: a pseudo-terminal
  double periodMs = 9;  // the paper's receiver
};

// Collects back-to-back characters to send them in one piece: sent singly they would be separated by silences.
class Bursts {
 public:
  explicit Bursts(uint32_t characterUs) : _characterUs(characterUs) {}

  void put(const line::Character &character) {
    _lastEndUs = character.endUs;
    if (!character.bad) {
      _bytes.push_back(character.value);
    }
  }

  // Returns the burst if it is complete; otherwise nothing.
  std::vector<uint8_t> take(uint64_t nowUs) {
    const bool ready = nowUs >= _lastEndUs + 2 * _characterUs || _bytes.size() >= BurstMax;
    return ready ? std::exchange(_bytes, {}) : std::vector<uint8_t>();
  }

 private:
  static constexpr size_t BurstMax = 64;

  uint32_t _characterUs;
  std::vector<uint8_t> _bytes;
  uint64_t _lastEndUs = 0;
};

// Sends this line. On a pseudo-terminal, first waits for a reader. Throws std::runtime_error.
void sendAll(Input &input, const std::string &to) {
  input.check();
  Destination destination(to, input.settings());
  if (!destination.waitForReader(input.seconds())) {
    return;
  }
  std::fputs("sending; Ctrl-C ends it\n", stderr);
  unsigned long sent = 0;
  unsigned long lost = 0;
  unsigned long bad = 0;
  Bursts bursts(input.settings().characterUs());
  input.run(
      [&](const line::Character &character) {
        bad += character.bad;
        bursts.put(character);
      },
      [&](uint64_t nowUs) {
        const std::vector<uint8_t> bytes = bursts.take(nowUs);
        if (!bytes.empty()) {
          const size_t count = destination.send(nowUs, bytes);
          sent += count;
          lost += bytes.size() - count;
          if (destination.isGone()) {
            input.end();
          }
        }
      });
  destination.finish();
  const std::string summary =
      std::to_string(sent) + " characters sent" +
      (lost > 0 ? "; " + std::to_string(lost) + " lost: the reader was too slow or gone" : "") +
      (bad > 0 ? "; " + std::to_string(bad) + " with errors left out: no port can send them" : "");
  std::fprintf(stderr, "%s\n", summary.c_str());
  if (destination.isGone()) {
    throw std::runtime_error(to + ": no program reads it any longer; start the reader, then this again");
  }
}

void sendLive(const Options &options) {
  BridgeOptions unchanged;
  Receiver receiver(options.source);
  Bridge bridge(unchanged, receiver, nullptr, options.to);
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
    sendLive(options);
    return;
  }
  const std::unique_ptr<Input> input = options.source.open();
  sendAll(*input, options.to);
}

}  // namespace

void addSend(CLI::App &app) {
  Subcommand subcommand(app, "send", "sends a recording, the built-in receiver, or values such as ch3=172");
  const auto options = std::make_shared<Options>(subcommand);
  subcommand.option("--port", options->to, "a serial port; without it, a pseudo-terminal (prints its name)")
      .type("DEVICE");
  subcommand.option("--period", options->periodMs, "the frame period of values, in ms (9)").between(1, 1000).type("MS");
  subcommand.footer(
      "Of a live line only frames are sent, and none older than 0.1 s: failsafe frames take their place. "
      "Values: ch1 to ch16 are raw, 0 to 2047, microseconds (1500us), percent (-50%), on (the high end) or off; "
      "ch17, ch18, failsafe and lostframe are on or off. A channel without a value is 992; CH3, the throttle, is "
      "172. A serial port's TXD must be inverted to drive a flight controller.");
  subcommand.run([options] { run(*options); });
}

}  // namespace tool
