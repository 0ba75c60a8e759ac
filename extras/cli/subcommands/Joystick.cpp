// sbus joystick: creates a game controller that moves like the transmitter's sticks.

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "cli/CalibrationFile.h"
#include "cli/GameController.h"
#include "cli/SilenceNote.h"
#include "cli/options/RangeOption.h"
#include "cli/options/SourceOption.h"
#include "cli/subcommands/Subcommands.h"
#include "line/Format.h"
#include "line/Observer.h"

namespace tool {

namespace {

using State = GameController::State;

constexpr size_t ChannelMax = GameController::Axes + GameController::Buttons;  // CH1..CH32
constexpr int Pressed = GameController::AxisEnd / 2;  // the middle of a three-position switch is off

// A program can no longer read the last report once the device is gone: the kernel returns nothing more
// (drivers/input/evdev.c, evdev_read()). This is three reads for a game that reads 30 times a second.
constexpr std::chrono::milliseconds TimeToRead(100);

struct Options {
  std::unique_ptr<RangeOption> range;
  std::string calibration;  // a file
  std::string map = "1,2,3,4,5,6,7,8";
  int throttle = 3;  // -3: closed at its high end
  Option throttleOption;
  std::string failsafe = "centre";
};

// The channels, counted from 0, that move the axes and press the buttons.
struct Map {
  struct Axis {
    size_t channel;
    int sign;  // -1: reversed
  };
  std::vector<Axis> axes;
  std::vector<size_t> buttons;
};

// The sticks of a game controller, for a radio with aileron, elevator, throttle and rudder on CH1..CH4: the left one is
// X and Y, the right one RX and RY, and up is -100 % (Linux, Documentation/input/gamepad.rst).
const std::pair<const char *, const char *> Modes[] = {{"mode1", "4,-2,5,1,-3,6,7,8"},
                                                       {"mode2", "4,-3,5,1,-2,6,7,8"},
                                                       {"mode3", "1,-2,5,4,-3,6,7,8"},
                                                       {"mode4", "1,-3,5,4,-2,6,7,8"}};

[[noreturn]] void rejectMap(const std::string &text) {
  rejectCommandLine(
      "--map: mode1 to mode4, or eight different channels of 16 such as 1,2,3,-4,5,6,7,8 are expected, not " + text);
}

Map mapOf(const std::string &text) {
  const auto mode =
      std::find_if(std::begin(Modes), std::end(Modes), [&](const auto &each) { return text == each.first; });
  const std::string list = mode != std::end(Modes) ? mode->second : text;
  Map map;
  std::array<bool, ChannelMax> moves{};
  const char *at = list.c_str();
  for (bool more = true; more; at++) {
    char *end = nullptr;
    const long number = std::strtol(at, &end, 10);
    const bool isChannel = number != 0 && number >= -sbus::ProportionalCount && number <= sbus::ProportionalCount;
    const size_t channel = isChannel ? static_cast<size_t>(std::abs(number)) - 1 : 0;
    if (!isChannel || std::exchange(moves[channel], true) || (*end != ',' && *end != '\0')) {
      rejectMap(text);
    }
    map.axes.push_back({channel, number < 0 ? -1 : 1});
    more = *end == ',';
    at = end;
  }
  if (map.axes.size() != GameController::Axes) {
    rejectMap(text);
  }
  for (size_t channel = 0; channel < ChannelMax; channel++) {
    if (!moves[channel]) {
      map.buttons.push_back(channel);
    }
  }
  return map;
}

ChannelRanges rangesOf(const Options &options) {
  ChannelRanges ranges;
  ranges.fill(options.range->range());
  if (!options.calibration.empty()) {
    readCalibration(options.calibration, ranges);
  }
  return ranges;
}

// Returns the channels for a lost link: centred, with the throttle closed.
line::Values valuesAtRest(const Options &options, const Map &map, const ChannelRanges &ranges) {
  const size_t channel = static_cast<size_t>(std::abs(options.throttle)) - 1;  // 0 wraps: no channel
  const bool moves =
      std::any_of(map.axes.begin(), map.axes.end(), [&](const Map::Axis &axis) { return axis.channel == channel; });
  if (options.throttleOption.given() && !moves) {
    rejectCommandLine(
        "--throttle: a channel that moves an axis is expected, negative if its high end is closed, such as -3; not " +
        std::to_string(options.throttle));
  }
  line::Values values;
  std::transform(ranges.begin(), ranges.end(), values.raw.begin(),
                 [](const sbus::Range &range) { return range.centre; });
  if (moves) {
    values.raw[channel] = options.throttle < 0 ? ranges[channel].high : ranges[channel].low;
  }
  return values;
}

// Returns the controller's state for the channels of the newest frame.
State stateOf(const line::Values &values, const Map &map, const ChannelRanges &ranges) {
  const auto part = [&](size_t channel) {
    return sbus::limited(sbus::toNormalized(values.raw[channel], ranges[channel]), -GameController::AxisEnd,
                         GameController::AxisEnd);
  };
  const auto isOn = [&](size_t channel) {
    const size_t digital = channel - sbus::ProportionalCount;
    return channel < values.count ? part(channel) > Pressed
                                  : digital < values.switches.size() && values.switches[digital];
  };
  State state;
  std::transform(map.axes.begin(), map.axes.end(), state.axes.begin(),
                 [&](const Map::Axis &axis) { return axis.sign * part(axis.channel); });
  std::transform(map.buttons.begin(), map.buttons.end(), state.buttons.begin(), isOn);
  return state;
}

void run(const SourceOption &source, const Options &options) {
  const ChannelRanges ranges = rangesOf(options);
  const Map map = mapOf(options.map);
  const State rest = stateOf(valuesAtRest(options, map, ranges), map, ranges);

  const std::unique_ptr<Input> input = source.open();
  GameController controller(rest);
  std::fprintf(stderr, "%s: a game controller with 8 axes and 24 buttons; Ctrl-C ends it\n", controller.name().c_str());
  line::Observer observer;
  observer.reset(0, input->settings().characterUs());
  const auto show = [&](uint64_t nowUs) {
    if (observer.hasLink(nowUs)) {
      controller.write(stateOf(observer.newest(), map, ranges));
    } else if (options.failsafe == "centre") {
      controller.write(rest);
    }
  };
  observer.listen([&](const line::Stretch &stretch) {
    if (stretch.isFrame()) {
      show(stretch.endUs());
    }
  });
  SilenceNote silence(source.name(), "frames");
  input->endOnFailure();
  input->run(
      [&](const line::Character &character) { observer.put(character); },
      [&](uint64_t nowUs) {
        observer.idleUntil(input->knownUs());
        show(nowUs);
        silence.tick(nowUs, observer.counters().frames > 0);
      });
  if (options.failsafe == "centre") {
    controller.write(rest);
    std::this_thread::sleep_for(TimeToRead);
  }
  input->requireWhole();
  silence.end(observer.counters().frames > 0);
}

}  // namespace

void addJoystick(CLI::App &app) {
  Subcommand subcommand(app, "joystick", "creates a game controller that moves like the transmitter's sticks");
  const auto source = std::make_shared<SourceOption>(subcommand, Playback::RealTime, Rows::Rejected);
  const auto options = std::make_shared<Options>();
  options->range = std::make_unique<RangeOption>(subcommand);
  subcommand
      .option("--calibration", options->calibration, "FILE from sbus calibrate, in place of --range for its channels")
      .notEmpty()
      .type("FILE");
  subcommand
      .option("--map", options->map, "the channels of the axes X, Y, Z, RX, RY, RZ, throttle, rudder; -3: reversed")
      .type("mode1|mode2|mode3|mode4|CH,CH,...");
  options->throttleOption =
      subcommand.option("--throttle", options->throttle, "the channel that a lost link closes; -3: at its high end (3)")
          .between(-16, 16)
          .type("CH");
  subcommand
      .option("--failsafe", options->failsafe,
              "without a link, centre all axes and close the throttle, or hold them (centre)")
      .oneOf({"centre", "hold"})
      .type("centre|hold");
  subcommand.footer(
      "Channels that move no axis are buttons, the lowest first: CH9 to CH16, then CH17 and CH18. --map mode2 is "
      "for games that expect two sticks; simulators ask for the axes themselves. It needs /dev/uinput, and says how "
      "to get access.");
  subcommand.run([source, options] { run(*source, *options); });
}

}  // namespace tool
