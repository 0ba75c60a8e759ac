// sbus monitor: shows a line's channels, flags, times and losses live on a page.

#include <chrono>
#include <cstdio>
#include <functional>
#include <memory>
#include <thread>

#include "cli/LineRecorder.h"
#include "cli/Output.h"
#include "cli/Stop.h"
#include "cli/monitor/MonitorPage.h"
#include "cli/monitor/MonitoredLine.h"
#include "cli/monitor/Screen.h"
#include "cli/options/RangeOption.h"
#include "cli/options/SensorOption.h"
#include "cli/options/SourceOption.h"
#include "cli/subcommands/Subcommands.h"

namespace tool {

namespace {

constexpr uint64_t PeriodUs = 50000;  // between updates of the page: the eye cannot follow faster
constexpr uint64_t LineUs = 1000000;  // between two printed lines
constexpr uint64_t LookUs = 10000;    // between two checks of the state

struct MonitorOptions {
  std::string record;  // a file
  bool json = false;
  std::unique_ptr<RangeOption> range;
  std::unique_ptr<SensorOption> sensors;
};

class Page {
 public:
  explicit Page(MonitoredLine &watch) : _watch(watch) {}

  // Returns false after the key that quits.
  bool takeKeys() {
    for (int key = _screen.key(); key != 0; key = _screen.key()) {
      press(key);
    }
    return !_quit;
  }

  void drawNowAndThen(uint64_t nowUs) {
    if (nowUs >= _nextUs) {
      _nextUs = nowUs + PeriodUs;
      draw(nowUs);
    }
  }

  // Keeps showing the line's last state, at `endUs`, until a key quits the page or --seconds are over.
  void stay(uint64_t endUs, uint64_t limitUs) {
    _ended = true;
    for (uint64_t nowUs = endUs; takeKeys() && !stopped() && nowUs < limitUs; nowUs += PeriodUs) {
      draw(endUs);
      std::this_thread::sleep_for(std::chrono::microseconds(PeriodUs));
    }
  }

 private:
  void press(int key) {
    if (_help) {
      _help = false;
    } else if (key == 'q' || key == 'Q') {
      _quit = true;
    } else if (key == 'r' || key == 'R') {
      _watch.reset();
      _paused = false;
    } else if (key == ' ') {
      _paused = !_paused;
    } else if (key == '?' || key == 'h') {
      _help = true;
    }
  }

  void draw(uint64_t nowUs) {
    if (!_paused) {
      _view = _watch.view(nowUs);
    }
    const char *const note = _paused ? "PAUSED: space continues" : _ended ? "ENDED: q quits" : "";
    _screen.draw(_help ? layOutHelp(_screen.size()) : layOut(_view, _screen.size(), _screen.unicode(), note));
  }

  MonitoredLine &_watch;
  Screen _screen;
  MonitorView _view;
  uint64_t _nextUs = 0;
  bool _paused = false;
  bool _help = false;
  bool _quit = false;
  bool _ended = false;
};

using Tick = std::function<void(uint64_t nowUs)>;

// Shows the line as a page. Calls `ended` once the line has ended, while the page stays.
void showPage(MonitoredLine &watch, Input &input, const std::function<void(const Tick &)> &run,
              const std::function<void()> &ended) {
  Page page(watch);
  uint64_t endUs = 0;
  run([&](uint64_t nowUs) {
    endUs = nowUs;
    if (!page.takeKeys()) {
      input.end();
    }
    page.drawNowAndThen(nowUs);
  });
  ended();
  page.stay(endUs, input.limitUs());
}

// Prints a line every second and whenever the state changes.
void showLines(MonitoredLine &watch, bool json, int64_t zeroUs, const std::function<void(const Tick &)> &run) {
  uint64_t lookUs = 0;
  uint64_t nextUs = LineUs;
  std::string state;
  run([&](uint64_t nowUs) {
    if (nowUs < lookUs) {
      return;
    }
    lookUs = nowUs + LookUs;
    const MonitorView view = watch.view(nowUs);
    if (nowUs >= nextUs || view.state != state) {
      nextUs += nowUs >= nextUs ? LineUs * (1 + (nowUs - nextUs) / LineUs) : 0;
      state = view.state;
      write(json ? watch.json(nowUs, zeroUs) : plainLine(view, static_cast<int64_t>(nowUs) + zeroUs));
    }
  });
  flush();
}

void show(const SourceOption &source, Input &input, const MonitorOptions &options, LineRecorder *recorder) {
  // Both FrSky and Futaba receivers turn a raw value into a pulse of 5 * raw / 8 + 880 us: Futaba's three points become
  // 1100, 1520 and 1940.
  const sbus::Range scale = options.range->range();
  const sbus::Range pulses = options.range->isMake() ? sbus::FrSky : scale;
  MonitoredLine watch(source.name(), source.hasTimes(), input.settings(), scale, pulses, options.sensors->sensors());
  if (options.json) {
    write(source.json().line());
  }
  uint64_t lastUs = 0;
  const auto put = [&](const line::Character &character) {
    watch.put(character);
    if (recorder != nullptr) {
      recorder->put(character);
    }
  };
  const auto read = [&](const Tick &tick) {
    input.run(put, [&](uint64_t nowUs) {
      lastUs = nowUs;
      watch.idleUntil(input.knownUs());
      tick(nowUs);
    });
  };
  const auto ended = [recorder] {
    if (recorder != nullptr) {
      recorder->finish();
    }
  };
  if (Screen::isPossible() && !options.json) {
    input.onNews([&](const std::string &text) { watch.news(text, lastUs); });
    showPage(watch, input, read, ended);
  } else {
    showLines(watch, options.json, source.zeroUs(), read);
    ended();
  }
}

void run(const SourceOption &source, const MonitorOptions &options) {
  options.range->range();  // rejects a wrong command line before the source is opened
  options.sensors->sensors();
  const std::unique_ptr<Input> input = source.open();
  if (options.record.empty()) {
    show(source, *input, options, nullptr);
    return;
  }
  writeTo(options.record, File::New, [&](const Put &put) {
    LineRecorder recorder("monitor " + source.name(), input->settings(), source.isFile() && source.isWire(),
                          source.hasTimes(), source.startUs(), source.zeroUs(), put);
    show(source, *input, options, &recorder);
    std::fprintf(stderr, "%s: %s\n", options.record.c_str(), recorder.summary().c_str());
  });
}

}  // namespace

void addMonitor(CLI::App &app) {
  Subcommand subcommand(app, "monitor", "shows channels, flags, times and losses on a page");
  const auto source = std::make_shared<SourceOption>(subcommand, Playback::RealTime);
  source->addRows(subcommand);
  const auto options = std::make_shared<MonitorOptions>();
  options->range = std::make_unique<RangeOption>(subcommand);
  subcommand.option("-o,--output", options->record, "also record the line; an existing file is not overwritten")
      .notStandardOutput()
      .type("FILE");
  options->sensors = std::make_unique<SensorOption>(subcommand);
  subcommand.flag("--json", options->json, "JSON lines in place of the page: one a second, and one at each change");
  subcommand.footer(
      "Keys: q quits, r resets marks and counters, space pauses, ? helps. The page stays after the line has ended, "
      "until "
      "--seconds are over. If standard output is not a terminal, it prints a line every second, and one when the state "
      "changes.");
  subcommand.run([source, options] { run(*source, *options); });
}

}  // namespace tool
