#include "cli/Input.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <stdexcept>
#include <thread>
#include <utility>

#include "cli/Output.h"
#include "cli/Stop.h"
#include "line/system/System.h"

namespace tool {

namespace {

constexpr uint64_t TickUs = 1000;

constexpr std::chrono::microseconds Soon(250);

}  // namespace

void Input::check() {
  _line->canAdvanceTo(_startUs);
  requireWhole();
}

void Input::requireWhole() const {
  if (!failure().empty()) {
    throw std::runtime_error(failure());
  }
}

uint64_t Input::clockUs() const {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return _pace == Pace::Live
             ? line::clockUs()
             : static_cast<uint64_t>(std::chrono::duration_cast<std::chrono::microseconds>(now).count());
}

void Input::wait() {
  if (std::exchange(_hurries, false)) {
    std::this_thread::sleep_for(Soon);
  } else if (!_line->wait()) {
    std::this_thread::sleep_for(std::chrono::microseconds(TickUs));
  }
}

void Input::begin() {
  if (_pace != Pace::AtOnce) {
    setLineByLine();
  }
  _startedUs = clockUs();
  _nowUs = _startUs;
  _endUs = _seconds > 0 ? _startUs + static_cast<uint64_t>(_seconds * 1e6) : UINT64_MAX;
  _line->opened(0);
}

// Returns how long ago a recorded or simulated character was due.
uint64_t Input::dueForUs(uint64_t endUs) const { return _nowUs - std::min(_nowUs, endUs); }

// Hands over the characters received so far. Returns false at the end.
bool Input::step(const Taker &taker) {
  for (line::Character character; _line->next(_nowUs, character);) {
    if (_pace != Pace::AtOnce && character.sinceUs == 0) {
      character.sinceUs = line::clockUs() - dueForUs(character.endUs);
    }
    taker.put(character);
  }
  _knownUs = _line->knownUs(_nowUs);
  taker.tick(_nowUs);
  const std::string news = _line->news();
  if (!news.empty() && _tell) {
    _tell(news);
  } else if (!news.empty()) {
    std::fprintf(stderr, "%s\n", news.c_str());
  }
  if (!_endsOnFailure) {
    requireWhole();
  }
  return !_ended && failure().empty() && !_line->finished(_nowUs) && _nowUs < _endUs;
}

// Moves on to the next time. Returns false if characters up to then are still missing.
bool Input::advance() {
  uint64_t nextUs = _nowUs + TickUs;
  if (_pace != Pace::AtOnce) {
    nextUs = _startUs + sinceUs();
  } else if (!_line->canAdvanceTo(nextUs)) {
    return false;
  }
  _nowUs = std::min(nextUs, _endUs);
  return true;
}

// Returns true if the seconds are over by the clock, even if no tick has come.
bool Input::isOverdue() const { return _seconds > 0 && static_cast<double>(sinceUs()) > _seconds * 1e6; }

void Input::run(const std::function<void(const line::Character &)> &put,
                const std::function<void(uint64_t nowUs)> &tick) {
  const Taker taker = {put, tick};
  begin();
  while (!stopped() && step(taker)) {
    if (_pace != Pace::AtOnce) {
      wait();
      advance();
      continue;
    }
    while (!advance() && !stopped()) {
      flush();
      wait();
      if (isOverdue()) {
        return;
      }
    }
  }
}

void Input::runBoth(Input &one, const Taker &takeOne, Input &other, const Taker &takeOther, int64_t aheadUs) {
  Input *const inputs[] = {&one, &other};
  const Taker *const takers[] = {&takeOne, &takeOther};
  const int64_t zeroUs[] = {aheadUs, 0};
  bool goesOn[] = {true, true};
  for (Input *const input : inputs) {
    input->begin();
  }
  const auto placeUs = [&](size_t i) { return static_cast<int64_t>(inputs[i]->_nowUs) + zeroUs[i]; };
  while (!stopped() && (goesOn[0] || goesOn[1])) {
    bool waits = true;
    for (const size_t i : {size_t{0}, size_t{1}}) {
      const bool isAtOnce = inputs[i]->_pace == Pace::AtOnce;
      const bool isAhead = goesOn[1 - i] && isAtOnce && placeUs(i) > placeUs(1 - i);
      if (goesOn[i] && !isAhead && inputs[i]->advance()) {
        goesOn[i] = inputs[i]->step(*takers[i]);
        if (goesOn[1 - i] && !inputs[i]->failure().empty()) {
          std::fprintf(stderr, "%s\n", inputs[i]->failure().c_str());
        }
        waits = waits && !isAtOnce;
      } else if (goesOn[i] && !isAhead && inputs[i]->isOverdue()) {
        goesOn[i] = false;
      }
    }
    if (waits) {
      flush();
      std::this_thread::sleep_for(Soon);
    }
  }
}

}  // namespace tool
