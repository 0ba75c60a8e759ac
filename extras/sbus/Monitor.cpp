// sbus monitor: a line's channels, flags, times and losses on a page, as they come.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <memory>
#include <thread>

#include "MonitorPage.h"
#include "Output.h"
#include "Screen.h"
#include "SourceOption.h"
#include "Stop.h"
#include "Subcommands.h"
#include "Watch.h"

namespace tool {

namespace {

constexpr uint64_t PeriodUs = 50000;  // of the page: more often nobody can read it
constexpr uint64_t LineUs = 1000000;  // of the lines
constexpr uint64_t LookUs = 10000;    // the state is asked so often

sbus::Range rangeOf(const std::string &text) {
  if (text == "frsky" || text == "futaba") {
    return text == "frsky" ? sbus::FrSky : sbus::Futaba;
  }
  unsigned low = 0, centre = 0, high = 0;
  char more = 0;
  const bool three = std::sscanf(text.c_str(), "%4u,%4u,%4u%c", &low, &centre, &high, &more) == 3;
  if (!three || std::max({low, centre, high}) > sbus::ChannelMax || low == centre || centre == high ||
      (low < centre) != (centre < high)) {
    throw CLI::ValidationError("--range", "frsky, futaba or raw values as 172,992,1811 are expected, not " + text);
  }
  return {static_cast<uint16_t>(low), static_cast<uint16_t>(centre), static_cast<uint16_t>(high)};
}

class Page {
 public:
  explicit Page(Watch &watch) : _watch(watch) {}

  // False once the user has had enough.
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

  // The line has ended: what was seen stays, until the user has had enough.
  void stay(uint64_t nowUs) {
    _ended = true;
    while (takeKeys() && !stopped()) {
      draw(nowUs);
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
    const char *const note = _paused ? "PAUSED: space goes on" : _ended ? "ENDED: q quits" : "";
    _screen.draw(_help ? layOutHelp(_screen.size()) : layOut(_view, _screen.size(), _screen.unicode(), note));
  }

  Watch &_watch;
  Screen _screen;
  MonitorView _view;
  uint64_t _nextUs = 0;
  bool _paused = false;
  bool _help = false;
  bool _quit = false;
  bool _ended = false;
};

using Tick = std::function<void(uint64_t nowUs)>;

void showPage(Watch &watch, Input &input, const std::function<void(const Tick &)> &run) {
  Page page(watch);
  uint64_t endUs = 0;
  run([&](uint64_t nowUs) {
    endUs = nowUs;
    if (!page.takeKeys()) {
      input.end();
    }
    page.drawNowAndThen(nowUs);
  });
  page.stay(endUs);
}

// A line a second, and one when the state changes.
void showLines(Watch &watch, const std::function<void(const Tick &)> &run) {
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
      nextUs += nowUs >= nextUs ? LineUs : 0;
      state = view.state;
      write(plainLine(view, nowUs));
    }
  });
  flush();
}

void run(const SourceOption &source, const std::string &range) {
  const sbus::Range scale = rangeOf(range);
  const std::unique_ptr<Input> input = source.open();
  Watch watch(source.name(), input->settings(), scale);
  uint64_t lastUs = 0;
  const auto read = [&](const Tick &tick) {
    input->run([&watch](const line::Character &character) { watch.put(character); },
               [&](uint64_t nowUs) {
                 lastUs = nowUs;
                 watch.idleUntil(input->knownUs());
                 tick(nowUs);
               });
  };
  if (Screen::isPossible()) {
    input->onNews([&](const std::string &text) { watch.news(text, lastUs); });
    showPage(watch, *input, read);
  } else {
    showLines(watch, read);
  }
}

}  // namespace

void addMonitor(CLI::App &app) {
  CLI::App *const subcommand = app.add_subcommand("monitor", "channels, flags, times and losses on a page");
  const auto source = std::make_shared<SourceOption>(*subcommand, Recordings::InTrueTime);
  const auto range = std::make_shared<std::string>("frsky");
  subcommand->add_option("--range", *range, "what is -100, 0 and +100 %: of a make, or raw values (frsky)")
      ->type_name("frsky|futaba|LOW,CENTRE,HIGH");
  subcommand->footer(
      "Keys: q quits, r resets marks and counters, space pauses, ? helps. The page stays when the line has "
      "ended. Where standard output is no terminal: a line a second, and one when the state changes.");
  subcommand->callback([source, range] { run(*source, *range); });
}

}  // namespace tool
