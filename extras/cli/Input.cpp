#include "cli/Input.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <stdexcept>
#include <thread>

#include "cli/Output.h"
#include "cli/Stop.h"

namespace tool {

namespace {

constexpr uint64_t TickUs = 1000;

uint64_t sinceUs(std::chrono::steady_clock::time_point start) {
  const auto time = std::chrono::steady_clock::now() - start;
  return static_cast<uint64_t>(std::chrono::duration_cast<std::chrono::microseconds>(time).count());
}

}  // namespace

void Input::check() {
  _line->mayGoTo(_startUs);
  if (!_line->failure().empty()) {
    throw std::runtime_error(_line->failure());
  }
}

void Input::wait() {
  if (!_line->wait()) {
    std::this_thread::sleep_for(std::chrono::microseconds(TickUs));
  }
}

void Input::run(const std::function<void(const line::Character &)> &put,
                const std::function<void(uint64_t nowUs)> &tick) {
  if (_pace == Pace::True) {
    setLineByLine();
  }
  const auto start = std::chrono::steady_clock::now();
  const uint64_t endUs = _seconds > 0 ? _startUs + static_cast<uint64_t>(_seconds * 1e6) : UINT64_MAX;
  _line->opened(0);
  for (uint64_t nowUs = _startUs; !_ended && !stopped();) {
    for (line::Character character; _line->next(nowUs, character);) {
      put(character);
    }
    _knownUs = _line->knownUs(nowUs);
    tick(nowUs);
    const std::string news = _line->news();
    if (!news.empty() && _tell) {
      _tell(news);
    } else if (!news.empty()) {
      std::fprintf(stderr, "%s\n", news.c_str());
    }
    if (!_line->failure().empty()) {
      throw std::runtime_error(_line->failure());
    }
    if (_line->finished(nowUs) || nowUs >= endUs) {
      return;
    }
    if (_pace == Pace::AtOnce) {
      nowUs += TickUs;
      while (!_line->mayGoTo(nowUs) && !stopped()) {
        flush();
        wait();
        if (_seconds > 0 && static_cast<double>(sinceUs(start)) > _seconds * 1e6) {
          return;  // nothing comes any more
        }
      }
    } else {
      wait();
      nowUs = _startUs + static_cast<uint64_t>(static_cast<double>(sinceUs(start)) * _speed);
    }
    nowUs = std::min(nowUs, endUs);
  }
}

}  // namespace tool
